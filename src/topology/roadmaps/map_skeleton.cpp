#include "topology/roadmaps/map_skeleton.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace mocha {
namespace {

constexpr int kTile = 64;            // cells along a side
constexpr double kNarrowest = 0.5;   // passage that obstacles are told apart by, of the required
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

  /// Straight to the nearest nodes that it sees, and to the nearest of the corners given.
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

/// The corner around p to which the straight line is cheapest; -1 if all are blocked.
int entry_corner(const DistanceField& field, const Vector2& p, const TravelCost& cost) {
  const Vector2 at = (p - field.origin()) / field.resolution_m();
  int best = -1;
  double least = TravelCost::kInfinity;
  for (int which = 0; which < 4; ++which) {
    const int x = std::clamp(static_cast<int>(at.x()) + which % 2, 0, field.columns() - 1);
    const int y = std::clamp(static_cast<int>(at.y()) + which / 2, 0, field.rows() - 1);
    const double cost_m = cost.of_line(p, field.corner(x, y));
    if (!(cost_m < least)) continue;
    least = cost_m;
    best = y * field.columns() + x;
  }
  return best;
}

bool holds(const CornerWindow& window, int x, int y) {
  return x >= window.x0 && x <= window.x1 && y >= window.y0 && y <= window.y1;
}

/// Parts of all tiles, numbered one tile after the other: which ones hang together.
class Parts {
 public:
  explicit Parts(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int root(int part) {
    while (parent_[part] != part) part = parent_[part] = parent_[parent_[part]];
    return part;
  }

  void join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace

MapSkeleton::MapSkeleton(std::shared_ptr<const DistanceField> field, const TravelOptions& options)
    : field_(std::move(field)),
      options_(options),
      tile_columns_((field_->columns() - 2) / kTile + 1),
      tile_rows_((field_->rows() - 2) / kTile + 1),
      tiles_(static_cast<std::size_t>(tile_columns_) * tile_rows_) {}

MapSkeleton::MapSkeleton(const MapSkeleton& before, std::shared_ptr<const DistanceField> field,
                         const CornerWindow& changed)
    : MapSkeleton(std::move(field), before.options_) {
  const std::lock_guard<std::mutex> lock(before.mutex_);
  tiles_ = before.tiles_;
  for (int tile = 0; tile < static_cast<int>(tiles_.size()); ++tile) {
    const CornerWindow own = window(tile);
    const bool apart =
        own.x1 < changed.x0 || own.x0 > changed.x1 || own.y1 < changed.y0 || own.y0 > changed.y1;
    if (!apart) tiles_[tile].reset();
  }
}

CornerWindow MapSkeleton::window(int tile) const {
  const int x0 = tile % tile_columns_ * kTile;
  const int y0 = tile / tile_columns_ * kTile;
  return {x0, y0, std::min(x0 + kTile, field_->columns() - 1),
          std::min(y0 + kTile, field_->rows() - 1)};
}

std::vector<int> MapSkeleton::tiles_at(const Vector2& low, const Vector2& high) const {
  const double tile_m = kTile * field_->resolution_m();
  const double margin_m = field_->resolution_m();
  const auto index = [&](double m, int axis, int count) {
    const double tiles = (m - field_->origin()[axis]) / tile_m;
    return static_cast<int>(std::clamp(std::floor(tiles), 0.0, count - 1.0));
  };
  std::vector<int> tiles;
  for (int y = index(low.y() - margin_m, 1, tile_rows_);
       y <= index(high.y() + margin_m, 1, tile_rows_); ++y) {
    for (int x = index(low.x() - margin_m, 0, tile_columns_);
         x <= index(high.x() + margin_m, 0, tile_columns_); ++x)
      tiles.push_back(y * tile_columns_ + x);
  }
  return tiles;
}

void MapSkeleton::complete(const TravelCost& cost) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_complete_) return;
  const TravelCost priced = anywhere(cost);
  tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t tile) {
    if (tiles_[tile]) return;
    const CornerWindow own = window(static_cast<int>(tile));
    tiles_[tile] = std::make_shared<Tile>(
        Tile{skeleton_tile(*field_, own, priced, {}),
             obstacle_tile(*field_, own, kNarrowest * options_.required_clearance_m)});
  });
  obstacles_ = joined_obstacles();
  is_complete_ = true;
}

std::vector<Vector2> MapSkeleton::joined_obstacles() const {
  std::vector<const ObstacleTile::Part*> parts;
  std::vector<int> first;  // of each tile
  for (const auto& tile : tiles_) {
    first.push_back(static_cast<int>(parts.size()));
    for (const ObstacleTile::Part& part : tile->obstacles.parts) parts.push_back(&part);
  }
  Parts joined(parts.size());
  std::unordered_map<int, int> at_corner;  // a part of those that go on there
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    for (const auto& [corner, part] : tiles_[tile]->obstacles.border) {
      const auto [known, is_new] = at_corner.emplace(corner, first[tile] + part);
      if (!is_new) joined.join(known->second, first[tile] + part);
    }
  }
  std::vector<const ObstacleTile::Part*> deepest(parts.size(), nullptr);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ObstacleTile::Part*& best = deepest[joined.root(static_cast<int>(i))];
    if (!best || parts[i]->distance_m < best->distance_m) best = parts[i];
  }
  std::vector<Vector2> obstacles;
  for (const ObstacleTile::Part* part : deepest) {
    if (part) obstacles.push_back(part->deepest);
  }
  return obstacles;
}

const std::vector<Vector2>& MapSkeleton::obstacles(const TravelCost& cost) const {
  complete(cost);
  return obstacles_;
}

Roadmap<2> MapSkeleton::roadmap(const TravelCost& cost, const Vector2& goal) const {
  complete(cost);
  const std::array<Vector2, 2> ends = {cost.start(), goal};
  std::map<int, std::vector<int>> remade;  // tiles that are special now, and their anchors
  std::array<int, 2> entries;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    entries[i] = entry_corner(*field_, ends[i], cost);
    for (const int tile : tiles_at(ends[i], ends[i])) {
      std::vector<int>& anchors = remade[tile];
      const CornerWindow own = window(tile);
      const int x = entries[i] % field_->columns();
      const int y = entries[i] / field_->columns();
      if (entries[i] >= 0 && holds(own, x, y)) anchors.push_back(entries[i]);
    }
  }
  const auto remake = [&](const Vector2& centre, double radius_m) {
    const Vector2 reach(radius_m, radius_m);
    for (const int tile : tiles_at(centre - reach, centre + reach)) remade[tile];
  };
  remake(cost.start(), options_.escape_radius_m);
  for (const BlockedDisc& disc : cost.blocked()) remake(disc.centre, disc.radius_m);
  Assembly assembly(*field_, cost.start(), goal);
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    const auto special = remade.find(static_cast<int>(tile));
    if (special == remade.end()) {
      assembly.add(tiles_[tile]->skeleton);
    } else {
      assembly.add(skeleton_tile(*field_, window(static_cast<int>(tile)), cost, special->second));
    }
  }
  for (int end = 0; end < 2; ++end) {
    if (entries[end] >= 0) assembly.join(end, assembly.node(entries[end]), cost);
    assembly.join_nearest(end, cost);
  }
  return assembly.take();
}

}  // namespace mocha
