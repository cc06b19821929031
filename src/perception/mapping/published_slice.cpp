#include "perception/mapping/published_slice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {
namespace {

constexpr double kHeadroom_m = 2.0;

/// With room to grow on the sides that `needed` reaches beyond.
CornerWindow grown_for(const CornerWindow& cells, const CornerWindow& needed, int headroom) {
  return {needed.x0 < cells.x0 ? needed.x0 - headroom : cells.x0,
          needed.y0 < cells.y0 ? needed.y0 - headroom : cells.y0,
          needed.x1 > cells.x1 ? needed.x1 + headroom : cells.x1,
          needed.y1 > cells.y1 ? needed.y1 + headroom : cells.y1};
}

}  // namespace

void PublishedSlice::mark(std::vector<Polygon> keep_out, Strip open) {
  keep_out_ = std::move(keep_out);
  open_ = std::move(open);
  marks_changed_ = true;
}

PublishedSlice::Change PublishedSlice::update(OccupancyMap& map, double border_m) {
  const double cell_m = map.options().resolution_m;
  const bool is_same_map = map.replaced() == replaced_;
  std::vector<CornerWindow> changes = map.take_changes();
  const CornerWindow marked_before = zones_around_;
  const bool is_marked_anew = std::exchange(marks_changed_, false);
  if (!is_same_map || is_marked_anew) find_zones(cell_m);
  if (is_marked_anew) {
    for (const CornerWindow& marked : {marked_before, zones_around_}) {
      if (!marked.empty()) changes.push_back(marked);
    }
  }
  const int border = static_cast<int>(std::ceil(border_m / cell_m));
  const CornerWindow needed = map.known_cells().grown(border).united(zones_around_);
  const int headroom = static_cast<int>(std::ceil(kHeadroom_m / cell_m));
  const bool grows = is_same_map && !knew_nothing_;
  const CornerWindow cells = grows ? grown_for(cells_, needed, headroom) : needed;
  replaced_ = map.replaced();
  knew_nothing_ = map.known_cells().empty();
  if (!is_same_map || !(cells == cells_)) {
    lay_out(map, cells);
    return {true, {}};
  }
  for (CornerWindow& window : changes) {
    copy(map, window);
    window = {window.x0 - cells_.x0, window.y0 - cells_.y0, window.x1 - cells_.x0,
              window.y1 - cells_.y0};
  }
  return {false, std::move(changes)};
}

void PublishedSlice::lay_out(const OccupancyMap& map, const CornerWindow& cells) {
  cells_ = cells;
  grid_.resolution_m = map.options().resolution_m;
  grid_.origin = grid_.resolution_m * Vector2(cells.x0, cells.y0);
  grid_.width = std::max(0, cells.columns());
  grid_.height = std::max(0, cells.rows());
  grid_.cells.resize(static_cast<std::size_t>(grid_.width) * grid_.height);
  copy(map, cells);
}

void PublishedSlice::find_zones(double resolution_m) {
  zones_.clear();
  zones_around_ = {0, 0, -1, -1};
  for (const Polygon& zone : keep_out_) {
    OccupancyGrid raster;
    raster.resolution_m = resolution_m;
    raster.origin = resolution_m * (zone.corners.front() / resolution_m).array().floor();
    raster = grown_to_hold(raster, zone.corners, 0.0);
    fill_polygon(raster, zone, OccupancyGrid::kOccupied);
    const Vector2 corner = (raster.origin / resolution_m).array().round();
    const Eigen::Vector2i first = corner.cast<int>();
    for (int y = 0; y < raster.height; ++y) {
      for (int x = 0; x < raster.width; ++x) {
        if (raster.at(x, y) != OccupancyGrid::kOccupied) continue;
        if (open_.covers(raster.cell_centre(x, y))) continue;
        const Run run{first.y() + y, first.x() + x, first.x() + x};
        const bool goes_on =
            !zones_.empty() && zones_.back().y == run.y && zones_.back().x1 + 1 == run.x0;
        goes_on ? void(zones_.back().x1 = run.x1) : zones_.push_back(run);
        zones_around_ = zones_around_.united({run.x0, run.y, run.x1, run.y});
      }
    }
  }
}

void PublishedSlice::copy(const OccupancyMap& map, const CornerWindow& cells) {
  if (cells.empty()) return;
  map.copy_slice(cells, {cells_.x0, cells_.y0}, grid_);
  for (const Run& run : zones_) {
    if (run.y < cells.y0 || run.y > cells.y1) continue;
    const int x0 = std::max(run.x0, cells.x0);
    const int count = std::min(run.x1, cells.x1) - x0 + 1;
    if (count > 0)
      std::fill_n(&grid_.at(x0 - cells_.x0, run.y - cells_.y0), count, OccupancyGrid::kOccupied);
  }
}

}  // namespace mocha
