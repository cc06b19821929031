#pragma once

#include <cstdint>
#include <vector>

#include "world/corner_window.h"
#include "world/obstacle.h"

namespace mocha {

/// A planar map of square cells, row by row from its lower left corner `origin` [m, map frame].
struct OccupancyGrid {
  static constexpr int8_t kUnknown = -1;
  static constexpr int8_t kFree = 0;
  static constexpr int8_t kOccupied = 100;

  double resolution_m = 0.05;
  Vector2 origin = Vector2::Zero();
  int width = 0;
  int height = 0;
  std::vector<int8_t> cells;  ///< width * height values: kUnknown, kFree or kOccupied

  bool contains(int x, int y) const { return x >= 0 && x < width && y >= 0 && y < height; }
  int8_t& at(int x, int y) { return cells[static_cast<std::size_t>(y) * width + x]; }
  int8_t at(int x, int y) const { return cells[static_cast<std::size_t>(y) * width + x]; }
  Vector2 cell_centre(int x, int y) const {
    return origin + resolution_m * Vector2(x + 0.5, y + 0.5);
  }
};

/// Whether the cell of a place, or one beside it, is occupied.
bool is_occupied_beside(const OccupancyGrid& grid, const Vector2& place);

/// The cell that is meant by how likely it is occupied [%], as nav_msgs/OccupancyGrid has it:
/// kOccupied from 65 on, kFree from 0 to 25, else kUnknown.
int8_t cell_of_probability(int8_t percent);

/// New values of some of a map's cells, row by row from the cell (x, y).
struct GridUpdate {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::vector<int8_t> cells;  ///< width * height

  bool fits(int grid_width, int grid_height) const {
    return x >= 0 && y >= 0 && width >= 0 && height >= 0 && width <= grid_width - x &&
           height <= grid_height - y && cells.size() == static_cast<std::size_t>(width) * height;
  }
};

// Windows of cells that the map holds, both ends included: as a map, and as an update.
OccupancyGrid part_of(const OccupancyGrid& grid, const CornerWindow& window);
GridUpdate cut_out(const OccupancyGrid& grid, const CornerWindow& window);
/// Of an update that fits.
void apply(const GridUpdate& update, OccupancyGrid& grid);

/// The same map on a grid that holds `points` with `border_m` around them as well; new cells are
/// unknown.
OccupancyGrid grown_to_hold(const OccupancyGrid& grid, const std::vector<Vector2>& points,
                            double border_m);

/// Sets every cell whose centre is within `radius_m` of `centre`.
void fill_disc(OccupancyGrid& grid, const Vector2& centre, double radius_m, int8_t value);

/// Sets every cell that the polygon touches, as far as the grid holds it.
void fill_polygon(OccupancyGrid& grid, const Polygon& polygon, int8_t value);

}  // namespace mocha
