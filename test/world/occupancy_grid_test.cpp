#include "world/occupancy_grid.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

OccupancyGrid free_grid(int width, int height) {
  OccupancyGrid grid;
  grid.resolution_m = 0.1;
  grid.origin = {-1.0, -1.0};
  grid.width = width;
  grid.height = height;
  grid.cells.assign(static_cast<std::size_t>(width) * height, OccupancyGrid::kFree);
  return grid;
}

int occupied(const OccupancyGrid& grid) {
  int count = 0;
  for (const int8_t cell : grid.cells) count += cell == OccupancyGrid::kOccupied;
  return count;
}

TEST(OccupancyGrid, CellsAreTheirProbabilities) {
  const std::pair<int, int8_t> cells[] = {
      {-128, OccupancyGrid::kUnknown}, {-1, OccupancyGrid::kUnknown},
      {0, OccupancyGrid::kFree},       {25, OccupancyGrid::kFree},
      {26, OccupancyGrid::kUnknown},   {64, OccupancyGrid::kUnknown},
      {65, OccupancyGrid::kOccupied},  {100, OccupancyGrid::kOccupied}};
  for (const auto& [percent, cell] : cells)
    EXPECT_EQ(cell_of_probability(static_cast<int8_t>(percent)), cell) << percent;
}

TEST(OccupancyGrid, FillsEveryCellThatAPolygonTouches) {
  OccupancyGrid grid = free_grid(20, 20);
  const Polygon triangle{{{-0.55, -0.55}, {0.55, -0.55}, {-0.55, 0.55}}};
  fill_polygon(grid, triangle, OccupancyGrid::kOccupied);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Vector2 centre = grid.cell_centre(x, y);
      const double distance_m = gap(centre, triangle).distance_m;
      if (distance_m <= 0.0499) {
        EXPECT_EQ(grid.at(x, y), OccupancyGrid::kOccupied) << centre.transpose();
      }
      if (distance_m > 0.0708) {
        EXPECT_EQ(grid.at(x, y), OccupancyGrid::kFree) << centre.transpose();
      }
    }
  }
}

TEST(OccupancyGrid, FillsThinPolygonsAndThoseThatReachOverItsEdge) {
  OccupancyGrid grid = free_grid(20, 20);
  fill_polygon(grid, {{{-0.95, 0.031}, {0.95, 0.032}, {0.95, 0.033}}}, OccupancyGrid::kOccupied);
  EXPECT_EQ(occupied(grid), 20);
  grid = free_grid(20, 20);
  fill_polygon(grid, {{{-9.0, -9.0}, {9.0, -9.0}, {9.0, 9.0}, {-9.0, 9.0}}},
               OccupancyGrid::kOccupied);
  EXPECT_EQ(occupied(grid), 400);
  grid = free_grid(20, 20);
  fill_polygon(grid, {{{5.0, 5.0}, {6.0, 5.0}, {5.0, 6.0}}}, OccupancyGrid::kOccupied);
  EXPECT_EQ(occupied(grid), 0);
}

TEST(OccupancyGrid, GrowsToHoldWhatItIsAskedTo) {
  OccupancyGrid grid = free_grid(20, 20);
  grid.at(0, 0) = OccupancyGrid::kOccupied;
  const OccupancyGrid grown = grown_to_hold(grid, {{2.0, -3.0}}, 0.5);
  EXPECT_GE(grown.origin.x() + 0.1 * grown.width, 2.5 - 1e-9);
  EXPECT_LE(grown.origin.y(), -3.5 + 1e-9);
  EXPECT_EQ(occupied(grown), 1);
  const Vector2 at = (grid.cell_centre(0, 0) - grown.origin) / 0.1;
  EXPECT_EQ(grown.at(static_cast<int>(at.x()), static_cast<int>(at.y())), OccupancyGrid::kOccupied);
  EXPECT_EQ(grown.at(0, 0), OccupancyGrid::kUnknown);
}

}  // namespace
}  // namespace mocha
