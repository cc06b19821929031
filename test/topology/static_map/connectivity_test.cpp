#include "topology/static_map/connectivity.h"

#include <gtest/gtest.h>

#include "topology/grid_world.h"

namespace mocha {
namespace {

const Vector2 kStart(0.5, 0.5);
const Vector2 kGoal(7.5, 5.5);

TEST(Connectivity, AWallWithADoorIsPassedByWhatFits) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {4.0, 0.0}, {4.2, 6.0});
  EXPECT_FALSE(Connectivity(*occupied_field(grid), 0.1).connects(kStart, kGoal));
  fill_box(grid, {4.0, 2.0}, {4.2, 3.0}, OccupancyGrid::kFree);
  const auto field = occupied_field(grid);
  EXPECT_TRUE(Connectivity(*field, 0.45).connects(kStart, kGoal));
  EXPECT_FALSE(Connectivity(*field, 0.55).connects(kStart, kGoal));
}

TEST(Connectivity, CornersThatTouchAreConnected) {
  // Free cells in a staircase.
  OccupancyGrid grid = free_grid({0.0, 0.0}, {2.0, 2.0}, 0.5);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      if (x != y) grid.at(x, y) = OccupancyGrid::kOccupied;
    }
  }
  EXPECT_TRUE(Connectivity(*occupied_field(grid), 0.0).connects({0.25, 0.25}, {1.75, 1.75}));
}

TEST(Connectivity, JoinsRowsThatMeetLate) {
  // Two combs, one inside the other: their teeth meet at the backs only.
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  for (int i = 1; i < 8; ++i)
    fill_box(grid, {i - 0.1, i % 2 == 0 ? 0.0 : 0.8}, {i + 0.1, i % 2 == 0 ? 5.2 : 6.0});
  const auto field = occupied_field(grid);
  EXPECT_TRUE(Connectivity(*field, 0.3).connects({0.5, 5.5}, {7.5, 0.5}));
  EXPECT_FALSE(Connectivity(*field, 0.42).connects({0.5, 5.5}, {7.5, 0.5}));
}

TEST(Connectivity, HoldsNothingInWallsOrOutside) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {4.0, 0.0}, {6.0, 6.0});
  const Connectivity space(*occupied_field(grid), 0.3);
  EXPECT_TRUE(space.holds(kStart));
  for (const Vector2& place :
       {Vector2(5.0, 3.0), Vector2(3.9, 3.0), Vector2(-0.5, 3.0), Vector2(1.0, 7.0),
        Vector2(9.0, 3.0), Vector2(1e300, 1.0), Vector2(1.0, std::nan(""))}) {
    EXPECT_FALSE(space.holds(place)) << place.transpose();
    EXPECT_FALSE(space.connects(kStart, place)) << place.transpose();
  }
  EXPECT_FALSE(space.nearest({5.0, 3.0}, kGoal));
}

TEST(Connectivity, TheNearestPlaceIsOnTheNearSide) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {4.0, 0.0}, {4.2, 6.0});
  const auto nearest = Connectivity(*occupied_field(grid), 0.3).nearest(kStart, {7.5, 3.0});
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->x(), 3.7, 0.051);
  EXPECT_NEAR(nearest->y(), 3.0, 0.051);
}

TEST(Connectivity, WhatItSeparatesNoPathConnects) {
  TravelOptions options{0.3, 0.3, 0.0, 0.0};
  int apart = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const auto field = occupied_field(random_world(seed, 60, kStart, kGoal, 0.4));
    const double least_m = options.required_clearance_m - M_SQRT1_2 * field->resolution_m();
    const bool connected = Connectivity(*field, least_m).connects(kStart, kGoal);
    const bool found =
        find_path_on_grid(field, kStart, kGoal, {}, options).outcome == GridPath::Outcome::kFound;
    EXPECT_TRUE(connected || !found) << seed;
    apart += !connected;
  }
  EXPECT_GT(apart, 5);
  EXPECT_LT(apart, 55);
}

}  // namespace
}  // namespace mocha
