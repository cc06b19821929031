#include "stack/known_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mocha {
namespace {

constexpr double kMostCells = 2.5e7;
constexpr int kPatch = 32;             // cells along a side: changes are repaired together
constexpr double kMostRepaired = 0.1;  // share of the map; beyond, all is made anew
constexpr double kSameCell = 1e-6;     // cells

bool is_same(const OccupancyGrid& a, const OccupancyGrid& b) {
  return a.resolution_m == b.resolution_m && a.origin == b.origin && a.width == b.width &&
         a.height == b.height && a.cells == b.cells;
}

/// Around the cells of each patch of the held map in which the new one differs.
std::vector<CornerWindow> changes(const OccupancyGrid& held, const OccupancyGrid& grid,
                                  const Eigen::Vector2i& place) {
  std::vector<CornerWindow> patches;
  for (int y = 0; y < grid.height; y += kPatch) {
    for (int x = 0; x < grid.width; x += kPatch) {
      CornerWindow patch{held.width, held.height, -1, -1};
      for (int cy = y; cy < std::min(y + kPatch, grid.height); ++cy) {
        const std::int8_t* now = &grid.cells[static_cast<std::size_t>(cy) * grid.width];
        const std::int8_t* before =
            &held.cells[static_cast<std::size_t>(cy + place.y()) * held.width + place.x()];
        const int end = std::min(x + kPatch, grid.width);
        if (std::equal(now + x, now + end, before + x)) continue;
        for (int cx = x; cx < end; ++cx) {
          if (now[cx] == before[cx]) continue;
          patch = {std::min(patch.x0, cx), std::min(patch.y0, cy), std::max(patch.x1, cx),
                   std::max(patch.y1, cy)};
        }
      }
      if (patch.empty()) continue;
      patches.push_back(
          {patch.x0 + place.x(), patch.y0 + place.y(), patch.x1 + place.x(), patch.y1 + place.y()});
    }
  }
  return patches;
}

/// A copy, if others look at it.
void make_own(std::shared_ptr<DistanceField>& field) {
  if (field && field.use_count() > 1) field = std::make_shared<DistanceField>(*field);
}

}  // namespace

bool KnownMap::take(OccupancyGrid grid) {
  const auto cells = static_cast<std::size_t>(std::max(0, grid.width)) * std::max(0, grid.height);
  if (cells == 0 || grid.cells.size() != cells || !(grid.resolution_m > 0.0) ||
      !grid.origin.allFinite())
    throw std::invalid_argument("the grid is empty, or its sizes or its place are none");
  if (is_same(grid, newest_)) return false;
  if (const auto place = place_of(grid)) {
    repair(grid, *place);
  } else {
    forget();
  }
  newest_ = std::move(grid);
  return true;
}

void KnownMap::forget() {
  held_ = OccupancyGrid();
  occupied_.reset();
  unseen_.reset();
  static_map_.reset();
}

std::optional<Eigen::Vector2i> KnownMap::place_of(const OccupancyGrid& grid) const {
  if (held_.width == 0 || grid.resolution_m != held_.resolution_m) return std::nullopt;
  const Vector2 at = (grid.origin - held_.origin) / grid.resolution_m;
  const Vector2 nearest(std::round(at.x()), std::round(at.y()));
  const Vector2 end = nearest + Vector2(grid.width, grid.height);
  const Vector2 before = (newest_.origin - held_.origin) / grid.resolution_m;
  const Vector2 before_end = before + Vector2(newest_.width, newest_.height);
  const bool covers =
      (before - nearest).minCoeff() >= -kSameCell && (end - before_end).minCoeff() >= -kSameCell;
  if (!covers || (at - nearest).cwiseAbs().maxCoeff() > kSameCell || nearest.minCoeff() < 0.0 ||
      end.x() > held_.width || end.y() > held_.height)
    return std::nullopt;
  return nearest.cast<int>();
}

void KnownMap::repair(const OccupancyGrid& grid, const Eigen::Vector2i& place) {
  const std::vector<CornerWindow> patches = changes(held_, grid, place);
  const double repaired = static_cast<double>(patches.size()) * kPatch * kPatch;
  if (repaired > kMostRepaired * static_cast<double>(held_.cells.size())) return forget();
  std::optional<SkeletonTiles> tiles = static_map_ ? static_map_->tiles() : std::nullopt;
  static_map_.reset();
  make_own(occupied_);
  make_own(unseen_);
  for (const CornerWindow& patch : patches) {
    for (int y = patch.y0; y <= patch.y1; ++y) {
      for (int x = patch.x0; x <= patch.x1; ++x)
        held_.at(x, y) = grid.at(x - place.x(), y - place.y());
    }
    if (unseen_) unseen_->repair(held_, patch);
    if (!occupied_) continue;
    const CornerWindow differ = occupied_->repair(held_, patch);
    if (tiles) tiles->forget(differ);
  }
  if (tiles) static_map_ = std::make_shared<GridStaticMap>(occupied_, std::move(*tiles));
}

bool KnownMap::holds(const Vector2& point) const {
  const Vector2 at = (point - held_.origin) / held_.resolution_m;
  return at.minCoeff() >= 1.0 && at.x() <= held_.width - 1 && at.y() <= held_.height - 1;
}

bool KnownMap::within_reach(const Vector2& point, double border_m) const {
  const Vector2 border = Vector2::Constant(border_m);
  const Vector2 size = newest_.resolution_m * Vector2(newest_.width, newest_.height);
  const Vector2 low = newest_.origin.cwiseMin(point - border);
  const Vector2 high = (newest_.origin + size).cwiseMax(point + border);
  return point.allFinite() &&
         (high - low).prod() <= kMostCells * newest_.resolution_m * newest_.resolution_m;
}

void KnownMap::hold(const std::vector<Vector2>& points, double border_m) {
  bool serves = held_.width > 0;
  std::vector<Vector2> reachable;
  for (const Vector2& point : points) {
    if (!within_reach(point, border_m)) continue;
    reachable.push_back(point);
    serves = serves && holds(point);
  }
  if (serves) return;
  forget();
  held_ = grown_to_hold(newest_, reachable, border_m);
}

std::shared_ptr<DistanceField>& KnownMap::field_of(Solid solid) {
  std::shared_ptr<DistanceField>& field = solid == Solid::kOccupied ? occupied_ : unseen_;
  if (!field) field = std::make_shared<DistanceField>(held_, solid);
  return field;
}

std::shared_ptr<const DistanceField> KnownMap::field(Solid solid,
                                                     const std::vector<Vector2>& points,
                                                     double border_m) {
  hold(points, border_m);
  return field_of(solid);
}

std::shared_ptr<const StaticMap> KnownMap::static_map(const std::vector<Vector2>& points,
                                                      double border_m) {
  hold(points, border_m);
  if (!static_map_) static_map_ = std::make_shared<GridStaticMap>(field_of(Solid::kOccupied));
  return static_map_;
}

}  // namespace mocha
