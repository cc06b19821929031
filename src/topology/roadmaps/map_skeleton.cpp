#include "topology/roadmaps/map_skeleton.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "topology/static_map/lattice.h"
#include "topology/static_map/union_find.h"

namespace mocha {
namespace {

constexpr std::size_t kInSight = 8;  // nodes that straight edges from start and goal are tried to

/// What a metre costs from no start in particular, with nobody in the way.
TravelCost anywhere(const TravelCost& cost) {
  TravelOptions options = cost.options();
  options.escape_radius_m = 0.0;
  return TravelCost(cost.static_map(), cost.start(), {}, options);
}

/// Numbers the corners that are nodes.
class Assembly {
 public:
  Assembly(const DistanceField& field, const Vector2& start, const Vector2& goal) : field_(field) {
    for (const Vector2& end : {start, goal})
      roadmap_.nodes.push_back({end, field.sample(end).distance_m});
  }

  /// For about as much as there is in tiles.
  void reserve(const SkeletonTiles& tiles) {
    std::size_t nodes = 0;
    std::size_t edges = 0;
    for (int tile = 0; tile < tiles.size(); ++tile) {
      nodes += tiles[tile].skeleton.nodes.size();
      edges += tiles[tile].skeleton.edges.size();
    }
    roadmap_.nodes.reserve(nodes);
    roadmap_.edges.reserve(edges);
    node_of_.reserve(nodes);
  }

  void add(const SkeletonTile& tile) {
    numbers_.clear();
    for (const int corner : tile.nodes) numbers_.push_back(node(corner));
    for (const auto& edge : tile.edges) {
      roadmap_.edges.push_back(
          {numbers_[edge.from], numbers_[edge.to], edge.between, edge.cost_m, 0.0});
    }
  }

  /// Straight, where that is possible.
  void join(int end, int to, const TravelCost& cost) {
    const double cost_m = cost.of_line(roadmap_.nodes[end].position, roadmap_.nodes[to].position);
    if (std::isfinite(cost_m)) roadmap_.edges.push_back({end, to, {}, cost_m, 0.0});
  }

  /// Straight to those of the nearest nodes that it sees.
  void join_nearest(int end, const TravelCost& cost) {
    const Vector2 place = roadmap_.nodes[end].position;
    std::vector<std::pair<double, int>> others;
    for (int i = 0; i < static_cast<int>(roadmap_.nodes.size()); ++i) {
      if (i != end) others.emplace_back((roadmap_.nodes[i].position - place).squaredNorm(), i);
    }
    const std::size_t near = std::min(kInSight, others.size());
    std::partial_sort(others.begin(), others.begin() + near, others.end());
    for (std::size_t k = 0; k < near; ++k) join(end, others[k].second, cost);
  }

  int node(int corner) {
    const auto [at, is_new] = node_of_.emplace(corner, static_cast<int>(roadmap_.nodes.size()));
    if (is_new) {
      const int x = corner % field_.columns();
      const int y = corner / field_.columns();
      roadmap_.nodes.push_back({field_.corner(x, y), field_.at_corner(x, y)});
    }
    return at->second;
  }

  Roadmap<2> take() { return std::move(roadmap_); }

 private:
  const DistanceField& field_;
  Roadmap<2> roadmap_;
  std::unordered_map<int, int> node_of_;  // by the number of its corner
  std::vector<int> numbers_;              // of the nodes of a tile
};

}  // namespace

MapSkeleton::MapSkeleton(std::shared_ptr<const DistanceField> field, SkeletonTiles tiles)
    : field_(std::move(field)), options_(tiles.options()), tiles_(std::move(tiles)) {
  if (tiles_.columns() != field_->columns() || tiles_.rows() != field_->rows())
    throw std::invalid_argument("MapSkeleton: the tiles are those of a map of another size");
}

SkeletonTiles MapSkeleton::tiles() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return tiles_;
}

CornerWindow MapSkeleton::around(const Vector2& place, double radius_m) const {
  const auto corner = [&](double m, int axis, int corners) {
    const double cells = (m - field_->origin()[axis]) / field_->resolution_m();
    return static_cast<int>(std::clamp(cells, 0.0, corners - 1.0));
  };
  const double reach_m = radius_m + field_->resolution_m();
  return {corner(place.x() - reach_m, 0, field_->columns()),
          corner(place.y() - reach_m, 1, field_->rows()),
          corner(place.x() + reach_m, 0, field_->columns()),
          corner(place.y() + reach_m, 1, field_->rows())};
}

bool MapSkeleton::complete(const TravelCost& cost, const std::function<bool()>& should_stop) const {
  SkeletonTiles made = tiles();
  if (is_complete_) return true;
  const TravelCost priced = anywhere(cost);
  const double narrow_m = kNarrowestPassage * options().required_clearance_m;
  // Not locked: others who ask for what is made do not wait.
  tbb::parallel_for(tbb::blocked_range<int>(0, made.size()), [&](const auto& range) {
    SkeletonTiler tiler(*field_, priced);
    for (int tile = range.begin(); tile < range.end() && !should_stop(); ++tile) {
      if (made.has(tile)) continue;
      const CornerWindow own = made.window(tile);
      made.set(tile, {tiler.tile(own, {}), obstacle_tile(*field_, own, narrow_m)});
    }
  });
  const bool all = !should_stop();
  std::vector<Vector2> obstacles;
  if (all) obstacles = joined_obstacles(made);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_complete_) return true;
  tiles_ = std::move(made);
  obstacles_ = std::move(obstacles);
  is_complete_ = all;
  return all;
}

std::vector<Vector2> MapSkeleton::joined_obstacles(const SkeletonTiles& tiles) {
  std::vector<const ObstacleTile::Part*> parts;
  std::vector<int> first;  // of each tile
  for (int tile = 0; tile < tiles.size(); ++tile) {
    first.push_back(static_cast<int>(parts.size()));
    for (const ObstacleTile::Part& part : tiles[tile].obstacles.parts) parts.push_back(&part);
  }
  UnionFind joined(static_cast<int>(parts.size()));
  std::unordered_map<int, int> at_corner;  // a part of those that go on there
  for (int tile = 0; tile < tiles.size(); ++tile) {
    for (const auto& [corner, part] : tiles[tile].obstacles.border) {
      const auto [known, is_new] = at_corner.emplace(corner, first[tile] + part);
      if (!is_new) joined.join(known->second, first[tile] + part);
    }
  }
  std::vector<ObstacleTile::Part> whole(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ObstacleTile::Part& obstacle = whole[joined.root(static_cast<int>(i))];
    obstacle.solid_corners += parts[i]->solid_corners;
    obstacle.sum += parts[i]->sum;
  }
  // The nearest to the mean, so that a path which only touches the rim of the matter is still
  // classified by the side on which it passes.
  std::vector<double> away_m(parts.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const int root = joined.root(static_cast<int>(i));
    const Vector2 mean = whole[root].sum / std::max(1, whole[root].solid_corners);
    const double this_m = (parts[i]->innermost - mean).norm();
    if (parts[i]->solid_corners == 0 || !(this_m < away_m[root])) continue;
    away_m[root] = this_m;
    whole[root].innermost = parts[i]->innermost;
  }
  std::vector<Vector2> obstacles;
  for (const ObstacleTile::Part& obstacle : whole) {
    if (obstacle.solid_corners > 0) obstacles.push_back(obstacle.innermost);
  }
  return obstacles;
}

Roadmap<2> MapSkeleton::roadmap(const TravelCost& cost, const Vector2& goal) const {
  std::map<int, std::vector<int>> remade;  // tiles that are special now, and their anchors
  const auto remake = [&](const Vector2& place, double radius_m) {
    for (const int tile : tiles_.at(around(place, radius_m))) remade[tile];
  };
  remake(cost.start(), options().escape_radius_m);
  remake(goal, 0.0);
  for (const BlockedDisc& disc : cost.blocked()) remake(disc.centre, disc.radius_m);
  Assembly assembly(*field_, cost.start(), goal);
  // At the step of the map's cells, the lattice has the numbers of the field's corners.
  const Lattice corners(cost.static_map(), field_->resolution_m());
  const std::array<int, 2> entries = {corners.entry(cost.start(), cost), corners.entry(goal, cost)};
  for (auto& [tile, anchors] : remade) {
    for (const int entry : entries) {
      const int x = entry % field_->columns();
      const int y = entry / field_->columns();
      if (entry >= 0 && tiles_.window(tile).holds(x, y)) anchors.push_back(entry);
    }
  }
  assembly.reserve(tiles_);
  SkeletonTiler tiler(*field_, cost);
  for (int tile = 0; tile < tiles_.size(); ++tile) {
    const auto special = remade.find(tile);
    if (special == remade.end()) {
      assembly.add(tiles_[tile].skeleton);
    } else {
      assembly.add(tiler.tile(tiles_.window(tile), special->second));
    }
  }
  for (int end = 0; end < 2; ++end) {
    if (entries[end] >= 0) assembly.join(end, assembly.node(entries[end]), cost);
    assembly.join_nearest(end, cost);
  }
  return assembly.take();
}

}  // namespace mocha
