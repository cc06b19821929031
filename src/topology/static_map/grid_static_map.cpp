#include "topology/static_map/grid_static_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "topology/roadmaps/map_skeleton.h"
#include "topology/static_map/obstacle_components.h"

namespace mocha {
namespace {

constexpr double kTile_m = 0.15;   // circles of at most this size, so that narrow paths stay open
constexpr double kRimCells = 1.5;  // matter deeper inside is hidden by that of the rim
constexpr double kJitter_m = 1e-4;

/// The corners of a map in a box, and those around it. Empty where the box is outside of the map.
CornerWindow corners_in(const DistanceField& field, const Eigen::AlignedBox2d& box) {
  const auto index = [&](double m, int axis, int corners) {
    const double cells = (m - field.origin()[axis]) / field.resolution_m();
    return static_cast<int>(std::clamp(cells, 0.0, static_cast<double>(corners)));
  };
  const double beyond_m = 1.5 * field.resolution_m();
  return {index(box.min().x(), 0, field.columns()), index(box.min().y(), 1, field.rows()),
          index(box.max().x() + beyond_m, 0, field.columns()) - 1,
          index(box.max().y() + beyond_m, 1, field.rows()) - 1};
}

/// The one nearest to their mean, so that a path which only touches the rim of the matter is still
/// classified by the side on which it passes.
Vector2 innermost(const std::vector<Vector2>& points) {
  Vector2 mean = Vector2::Zero();
  for (const Vector2& point : points) mean += point / static_cast<double>(points.size());
  return nearest_to(mean, points);
}

/// A little aside, so that no four circles touch a common one: only slow, exact arithmetic could
/// tell that from nearly touching.
Vector2 off_the_lattice(const Vector2& p) {
  const double angle = 1e3 * (p.x() + M_SQRT2 * p.y());
  return p + kJitter_m * Vector2(std::cos(angle), std::sin(M_SQRT2 * angle));
}

}  // namespace

GridStaticMap::GridStaticMap(std::shared_ptr<const DistanceField> field)
    : field_(std::move(field)),
      bounds_(field_->origin(), field_->corner(field_->columns() - 1, field_->rows() - 1)) {}

GridStaticMap::GridStaticMap(std::shared_ptr<const DistanceField> field, SkeletonTiles tiles)
    : GridStaticMap(std::move(field)) {
  skeleton_ = std::make_shared<MapSkeleton>(field_, std::move(tiles));
}

std::shared_ptr<const MapSkeleton> GridStaticMap::skeleton(const TravelOptions& options) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!skeleton_ || !(skeleton_->options() == options))
    skeleton_ = std::make_shared<MapSkeleton>(
        field_, SkeletonTiles(options, field_->columns(), field_->rows()));
  return skeleton_;
}

std::optional<SkeletonTiles> GridStaticMap::tiles() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return skeleton_ ? std::optional(skeleton_->tiles()) : std::nullopt;
}

std::vector<ObstacleGroup> GridStaticMap::groups_within(const Eigen::AlignedBox2d& box,
                                                        double clearance_m) const {
  const DistanceField& field = *field_;
  const double cell_m = field.resolution_m();
  const CornerWindow window = corners_in(field, box);
  const ObstacleComponents components(field, window, clearance_m, ObstacleComponents::Kind::kSolid);
  std::vector<ObstacleGroup> groups;
  for (int i = 0; i < components.size(); ++i)
    groups.push_back({innermost(components.solid(i)), {}});
  const int tile = std::max(1, static_cast<int>(std::lround(kTile_m / cell_m)));
  std::map<int, Eigen::AlignedBox2d> parts;  // of the tile, by component
  for (int y = window.y0; y <= window.y1; y += tile) {
    for (int x = window.x0; x <= window.x1; x += tile) {
      parts.clear();
      for (int cy = y; cy <= std::min(y + tile - 1, window.y1); ++cy) {
        for (int cx = x; cx <= std::min(x + tile - 1, window.x1); ++cx) {
          const double distance_m = field.at_corner(cx, cy);
          if (distance_m > 0.0 || distance_m < -kRimCells * cell_m) continue;
          parts[components.at(cx, cy)].extend(field.corner(cx, cy));
        }
      }
      for (const auto& [component, box] : parts) {
        groups[component].cover.push_back(
            {off_the_lattice(box.center()), 0.5 * box.diagonal().norm()});
      }
    }
  }
  return groups;
}

}  // namespace mocha
