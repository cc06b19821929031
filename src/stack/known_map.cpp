#include "stack/known_map.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mocha {
namespace {

constexpr double kMostCells = 2.5e7;
constexpr int kPatch = 32;          // cells along a side: changes are repaired together
constexpr double kSameCell = 1e-6;  // cells

/// Around the cells of each patch of the held map in which a new part of it differs.
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
  if (!field) return;
  if (field.use_count() > 1) field = std::make_shared<DistanceField>(*field);
  // What another thread has read before it let go is read before it changes here.
  std::atomic_thread_fence(std::memory_order_acquire);
}

}  // namespace

void KnownMap::take(OccupancyGrid grid) {
  const auto cells = static_cast<std::size_t>(std::max(0, grid.width)) * std::max(0, grid.height);
  if (cells == 0 || grid.cells.size() != cells || !(grid.resolution_m > 0.0) ||
      !grid.origin.allFinite())
    throw std::invalid_argument("the grid is empty, or its sizes or its place are none");
  const std::lock_guard<std::mutex> lock(pending_mutex_);
  width_ = grid.width;
  height_ = grid.height;
  pending_ = {std::move(grid), {}};
}

void KnownMap::take(GridUpdate update) {
  const std::lock_guard<std::mutex> lock(pending_mutex_);
  if (!update.fits(width_, height_))
    throw std::invalid_argument("the update is not within the grid, or its sizes do not match");
  if (!update.cells.empty()) pending_.updates.push_back(std::move(update));
}

bool KnownMap::available() const {
  const std::lock_guard<std::mutex> lock(pending_mutex_);
  return width_ > 0;
}

void KnownMap::digest() {
  Pending pending;
  {
    const std::lock_guard<std::mutex> lock(pending_mutex_);
    std::swap(pending, pending_);
  }
  if (pending.grid) {
    for (const GridUpdate& update : pending.updates) apply(update, *pending.grid);
    change_to(std::move(*pending.grid));
  } else if (!pending.updates.empty()) {
    update_by(pending.updates);
  }
}

void KnownMap::change_to(OccupancyGrid grid) {
  if (const auto place = place_of(grid)) {
    known_ = {place->x(), place->y(), place->x() + grid.width - 1, place->y() + grid.height - 1};
    return repair(grid, *place);
  }
  forget();
  known_ = {0, 0, grid.width - 1, grid.height - 1};
  held_ = std::move(grid);
  is_grown_ = false;
}

void KnownMap::update_by(const std::vector<GridUpdate>& updates) {
  CornerWindow around{0, 0, -1, -1};
  for (const GridUpdate& u : updates)
    around = around.united({u.x, u.y, u.x + u.width - 1, u.y + u.height - 1});
  const Eigen::Vector2i place(known_.x0 + around.x0, known_.y0 + around.y0);
  OccupancyGrid part =
      part_of(held_, {place.x(), place.y(), known_.x0 + around.x1, known_.y0 + around.y1});
  for (GridUpdate update : updates) {
    update.x -= around.x0;
    update.y -= around.y0;
    apply(update, part);
  }
  repair(part, place);
}

void KnownMap::forget() {
  occupied_.reset();
  unseen_.reset();
  static_map_.reset();
}

std::optional<Eigen::Vector2i> KnownMap::place_of(const OccupancyGrid& grid) const {
  if (known_.empty() || grid.resolution_m != held_.resolution_m) return std::nullopt;
  const Vector2 at = (grid.origin - held_.origin) / grid.resolution_m;
  const Vector2 nearest(std::round(at.x()), std::round(at.y()));
  const Vector2 end = nearest + Vector2(grid.width, grid.height);
  const bool covers = nearest.x() <= known_.x0 && nearest.y() <= known_.y0 && end.x() > known_.x1 &&
                      end.y() > known_.y1;
  if (!covers || (at - nearest).cwiseAbs().maxCoeff() > kSameCell || nearest.minCoeff() < 0.0 ||
      end.x() > held_.width || end.y() > held_.height)
    return std::nullopt;
  return nearest.cast<int>();
}

void KnownMap::repair(const OccupancyGrid& part, const Eigen::Vector2i& place) {
  const std::vector<CornerWindow> patches = changes(held_, part, place);
  if (patches.empty()) return;
  std::optional<SkeletonTiles> tiles = static_map_ ? static_map_->tiles() : std::nullopt;
  static_map_.reset();
  make_own(occupied_);
  make_own(unseen_);
  for (const CornerWindow& patch : patches) {
    for (int y = patch.y0; y <= patch.y1; ++y) {
      for (int x = patch.x0; x <= patch.x1; ++x)
        held_.at(x, y) = part.at(x - place.x(), y - place.y());
    }
  }
  if (unseen_) unseen_->repair(held_, patches);
  if (occupied_) {
    for (const CornerWindow& differ : occupied_->repair(held_, patches)) {
      if (tiles) tiles->forget(differ);
    }
  }
  if (tiles) static_map_ = std::make_shared<GridStaticMap>(occupied_, std::move(*tiles));
}

bool KnownMap::holds(const Vector2& point) const {
  const Vector2 at = (point - held_.origin) / held_.resolution_m;
  return at.minCoeff() >= 1.0 && at.x() <= held_.width - 1 && at.y() <= held_.height - 1;
}

bool KnownMap::within_reach(const Vector2& point, double border_m) const {
  const Vector2 border = Vector2::Constant(border_m);
  const double cell_m = held_.resolution_m;
  const Vector2 origin = held_.origin + cell_m * Vector2(known_.x0, known_.y0);
  const Vector2 low = origin.cwiseMin(point - border);
  const Vector2 high =
      (origin + cell_m * Vector2(known_.columns(), known_.rows())).cwiseMax(point + border);
  return point.allFinite() && (high - low).prod() <= kMostCells * cell_m * cell_m;
}

void KnownMap::hold(const std::vector<Vector2>& points, double border_m) {
  bool serves = is_grown_;
  std::vector<Vector2> reachable;
  for (const Vector2& point : points) {
    if (!within_reach(point, border_m)) continue;
    reachable.push_back(point);
    serves = serves && holds(point);
  }
  if (serves) return;
  forget();
  is_grown_ = true;
  const OccupancyGrid known = part_of(held_, known_);
  held_ = grown_to_hold(known, reachable, border_m);
  const Vector2 first = ((known.origin - held_.origin) / held_.resolution_m).array().round();
  const Eigen::Vector2i at = first.cast<int>();
  known_ = {at.x(), at.y(), at.x() + known.width - 1, at.y() + known.height - 1};
}

std::shared_ptr<DistanceField>& KnownMap::field_of(Solid solid) {
  std::shared_ptr<DistanceField>& field = solid == Solid::kOccupied ? occupied_ : unseen_;
  if (!field) field = std::make_shared<DistanceField>(held_, solid);
  return field;
}

OccupancyGrid KnownMap::newest() {
  const std::lock_guard<std::mutex> lock(mutex_);
  digest();
  return part_of(held_, known_);
}

std::shared_ptr<const DistanceField> KnownMap::field(Solid solid,
                                                     const std::vector<Vector2>& points,
                                                     double border_m) {
  const std::lock_guard<std::mutex> lock(mutex_);
  digest();
  hold(points, border_m);
  return field_of(solid);
}

std::shared_ptr<const StaticMap> KnownMap::static_map(const std::vector<Vector2>& points,
                                                      double border_m) {
  const std::lock_guard<std::mutex> lock(mutex_);
  digest();
  hold(points, border_m);
  if (!static_map_) static_map_ = std::make_shared<GridStaticMap>(field_of(Solid::kOccupied));
  return static_map_;
}

}  // namespace mocha
