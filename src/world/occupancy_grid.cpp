#include "world/occupancy_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {

bool is_occupied_beside(const OccupancyGrid& grid, const Vector2& place) {
  const Vector2 at = (place - grid.origin) / grid.resolution_m;
  const int x = static_cast<int>(std::floor(at.x()));
  const int y = static_cast<int>(std::floor(at.y()));
  for (int j = y - 1; j <= y + 1; ++j) {
    for (int i = x - 1; i <= x + 1; ++i) {
      if (grid.contains(i, j) && grid.at(i, j) == OccupancyGrid::kOccupied) return true;
    }
  }
  return false;
}

int8_t cell_of_probability(int8_t percent) {
  constexpr int kOccupiedFrom = 65;
  constexpr int kFreeUpTo = 25;
  if (percent >= kOccupiedFrom) return OccupancyGrid::kOccupied;
  return percent >= 0 && percent <= kFreeUpTo ? OccupancyGrid::kFree : OccupancyGrid::kUnknown;
}

GridUpdate cut_out(const OccupancyGrid& grid, const CornerWindow& window) {
  GridUpdate update{window.x0, window.y0, window.columns(), window.rows(), {}};
  update.cells.reserve(static_cast<std::size_t>(update.width) * update.height);
  for (int y = window.y0; y <= window.y1; ++y) {
    const int8_t* row = &grid.cells[static_cast<std::size_t>(y) * grid.width];
    update.cells.insert(update.cells.end(), row + window.x0, row + window.x1 + 1);
  }
  return update;
}

OccupancyGrid part_of(const OccupancyGrid& grid, const CornerWindow& window) {
  GridUpdate part = cut_out(grid, window);
  return {grid.resolution_m, grid.origin + grid.resolution_m * Vector2(part.x, part.y), part.width,
          part.height, std::move(part.cells)};
}

void apply(const GridUpdate& update, OccupancyGrid& grid) {
  for (int row = 0; row < update.height; ++row) {
    const int8_t* from = update.cells.data() + static_cast<std::size_t>(row) * update.width;
    std::copy(
        from, from + update.width,
        grid.cells.begin() + static_cast<std::ptrdiff_t>(update.y + row) * grid.width + update.x);
  }
}

OccupancyGrid grown_to_hold(const OccupancyGrid& grid, const std::vector<Vector2>& points,
                            double border_m) {
  int x0 = 0;
  int y0 = 0;
  int x1 = grid.width;
  int y1 = grid.height;
  for (const Vector2& point : points) {
    const Vector2 at = (point - grid.origin) / grid.resolution_m;
    const double border = border_m / grid.resolution_m;
    x0 = std::min(x0, static_cast<int>(std::floor(at.x() - border)));
    y0 = std::min(y0, static_cast<int>(std::floor(at.y() - border)));
    x1 = std::max(x1, static_cast<int>(std::ceil(at.x() + border)));
    y1 = std::max(y1, static_cast<int>(std::ceil(at.y() + border)));
  }
  OccupancyGrid grown;
  grown.resolution_m = grid.resolution_m;
  grown.origin = grid.origin + grid.resolution_m * Vector2(x0, y0);
  grown.width = x1 - x0;
  grown.height = y1 - y0;
  grown.cells.assign(static_cast<std::size_t>(grown.width) * grown.height, OccupancyGrid::kUnknown);
  for (int y = 0; y < grid.height; ++y) {
    const auto row = grid.cells.begin() + static_cast<std::ptrdiff_t>(y) * grid.width;
    std::copy(row, row + grid.width, &grown.at(-x0, y - y0));
  }
  return grown;
}

void fill_disc(OccupancyGrid& grid, const Vector2& centre, double radius_m, int8_t value) {
  const Vector2 at = (centre - grid.origin) / grid.resolution_m;
  const double radius = radius_m / grid.resolution_m;
  const int x0 = std::max(0, static_cast<int>(std::floor(at.x() - radius)));
  const int x1 = std::min(grid.width - 1, static_cast<int>(std::ceil(at.x() + radius)));
  const int y0 = std::max(0, static_cast<int>(std::floor(at.y() - radius)));
  const int y1 = std::min(grid.height - 1, static_cast<int>(std::ceil(at.y() + radius)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      if ((Vector2(x + 0.5, y + 0.5) - at).norm() <= radius) grid.at(x, y) = value;
    }
  }
}

void fill_polygon(OccupancyGrid& grid, const Polygon& polygon, int8_t value) {
  Eigen::AlignedBox2d box;
  for (const Vector2& corner : polygon.corners)
    box.extend((corner - grid.origin) / grid.resolution_m);
  const int x0 = std::max(0, static_cast<int>(std::floor(box.min().x())));
  const int x1 = std::min(grid.width - 1, static_cast<int>(std::floor(box.max().x())));
  const int y0 = std::max(0, static_cast<int>(std::floor(box.min().y())));
  const int y1 = std::min(grid.height - 1, static_cast<int>(std::floor(box.max().y())));
  const Vector2 half = Vector2::Constant(0.5 * grid.resolution_m);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vector2 centre = grid.cell_centre(x, y);
      const Polygon cell{{centre - half, centre + Vector2(half.x(), -half.y()), centre + half,
                          centre + Vector2(-half.x(), half.y())}};
      if (gap(Obstacle(cell), Obstacle(polygon)).distance_m <= 0.0) grid.at(x, y) = value;
    }
  }
}

}  // namespace mocha
