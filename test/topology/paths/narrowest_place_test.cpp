#include "topology/paths/narrowest_place.h"

#include <gtest/gtest.h>

#include "topology/grid_world.h"

namespace mocha {
namespace {

const Vector2 kStart(1.0, 2.0);
const Vector2 kGoal(9.0, 2.0);

/// A wall at x = 5 m with a door about y = `y`.
void add_wall(OccupancyGrid& grid, double x, double y, double width_m) {
  fill_box(grid, {x, 0.0}, {x + 0.2, y - 0.5 * width_m});
  fill_box(grid, {x, y + 0.5 * width_m}, {x + 0.2, 4.0});
}

std::optional<NarrowPlace> narrowest(const OccupancyGrid& grid) {
  return narrowest_place(*static_map_of(grid), kStart, kGoal, kLatticeStep_m, 0.5);
}

TEST(NarrowestPlace, IsTheDoor) {
  for (const double width_m : {0.3, 0.65, 0.8}) {
    OccupancyGrid grid = free_grid({0.0, 0.0}, {10.0, 4.0});
    add_wall(grid, 5.0, 2.0 + 0.5 * width_m, width_m);
    const auto narrow = narrowest(grid);
    ASSERT_TRUE(narrow);
    EXPECT_NEAR(narrow->place.x(), 5.1, 0.11);
    EXPECT_NEAR(narrow->place.y(), 2.0 + 0.5 * width_m, 0.03);
    EXPECT_NEAR(narrow->width_m, width_m, 0.01);
  }
}

TEST(NarrowestPlace, OfTwoDoorsBesideEachOtherIsTheWider) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {10.0, 4.0});
  fill_box(grid, {5.0, 0.0}, {5.2, 4.0});
  fill_box(grid, {5.0, 0.5}, {5.2, 1.0}, OccupancyGrid::kFree);
  fill_box(grid, {5.0, 3.0}, {5.2, 3.6}, OccupancyGrid::kFree);
  EXPECT_NEAR(narrowest(grid)->width_m, 0.6, 0.01);
  EXPECT_NEAR(narrowest(grid)->place.y(), 3.3, 0.03);
}

TEST(NarrowestPlace, OfTwoDoorsBehindEachOtherIsTheNarrower) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {10.0, 4.0});
  add_wall(grid, 4.0, 2.0, 0.6);
  add_wall(grid, 6.0, 2.5, 0.4);
  EXPECT_NEAR(narrowest(grid)->width_m, 0.4, 0.01);
  EXPECT_NEAR(narrowest(grid)->place.x(), 6.1, 0.11);
}

TEST(NarrowestPlace, ThereIsNoneThroughAWall) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {10.0, 4.0});
  fill_box(grid, {5.0, 0.0}, {5.2, 4.0});
  EXPECT_FALSE(narrowest(grid));
}

TEST(NarrowestPlace, WhereTheRobotStandsIsNone) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {10.0, 4.0});
  fill_box(grid, {0.8, 1.8}, {0.95, 2.2});
  fill_box(grid, {1.05, 1.8}, {1.2, 2.2});
  add_wall(grid, 5.0, 2.0, 0.6);
  EXPECT_NEAR(narrowest(grid)->width_m, 0.6, 0.01);
}

}  // namespace
}  // namespace mocha
