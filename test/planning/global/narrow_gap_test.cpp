#include <gtest/gtest.h>

#include <string>

#include "planning/candidates/path_clearance.h"
#include "planning/global/global_planner.h"
#include "planning/worlds.h"
#include "safety/certificate.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kStart_s = 1.7e9;
constexpr double kDoor_m = 3.0;

/// A wall with a door of this width, on a map with cells of 5 cm whose borders are closed.
OccupancyGrid door(double width_m) {
  OccupancyGrid grid = free_grid({-1.0, -2.0}, {7.0, 2.0});
  fill_box(grid, {kDoor_m, -2.0}, {kDoor_m + 0.2, 0.0});
  fill_box(grid, {kDoor_m, width_m}, {kDoor_m + 0.2, 2.0});
  for (const double y : {-2.0, 1.9}) fill_box(grid, {-1.0, y}, {7.0, y + 0.1});
  return grid;
}

class NarrowGap : public ::testing::Test {
 protected:
  PlanResult plan(const OccupancyGrid& grid) const {
    PlanQuery query;
    query.start_time_s = kStart_s;
    query.committed = standing(kStart_s - 1.0, {0.0, 0.5}, 0.0);
    query.goal = {6.0, 0.5};
    return planner_.plan(query, {static_map_of(grid), {}});
  }

  double slowest_in_the_door(const Motion& motion) const {
    double slowest = robot_.limits.max_speed;
    for (double t = kStart_s; t < motion.end_time(); t += 0.01) {
      if (std::abs(motion.position(t).x() - kDoor_m - 0.1) < 0.2)
        slowest = std::min(slowest, motion.velocity(t).norm());
    }
    return slowest;
  }

  const RobotModel robot_ = rover();
  const GlobalPlanner planner_{robot_, default_options()};
};

TEST_F(NarrowGap, TakesTheLongerTheNarrowerItIs) {
  const SpeedMargin margin = MarginBudget::of(robot_).static_margin();
  double wider_s = 0.0;
  for (const double width_m : {1.0, 0.8, 0.75, 0.7}) {
    const OccupancyGrid grid = door(width_m);
    const PlanResult result = plan(grid);
    ASSERT_EQ(result.reason, PlanReason::kSolved) << width_m << ": " << result.message;
    EXPECT_FALSE(
        check_clearance(result.motion, robot_.footprint, *occupied_field(grid), margin, kStart_s));
    const double speed = slowest_in_the_door(result.motion);
    EXPECT_GT(speed, 0.5 * kCreep_mps) << width_m;
    const double took_s = result.motion.end_time() - kStart_s;
    EXPECT_GT(took_s, wider_s) << width_m;
    EXPECT_LT(took_s, 20.0) << width_m;
    wider_s = took_s;
    if (width_m == 0.7) {
      EXPECT_LT(speed, 0.6);
    }
  }
}

TEST_F(NarrowGap, WithRoomToSpareItIsPassedAtFullSpeed) {
  const PlanResult result = plan(door(1.2));
  ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
  EXPECT_GT(slowest_in_the_door(result.motion), 0.85 * robot_.limits.max_speed);
}

TEST_F(NarrowGap, ThatIsTooNarrowIsNamedWithItsPlaceAndItsWidth) {
  const PlanResult result = plan(door(0.65));
  EXPECT_EQ(result.reason, PlanReason::kNoPath);
  for (const char* words : {"narrowest place", "(3.", "0.65 m wide", "needs 0.69 m"})
    EXPECT_NE(result.message.find(words), std::string::npos) << words << ": " << result.message;
  EXPECT_NEAR(passable_gap_m(robot_), 0.69, 1e-9);
}

}  // namespace
}  // namespace mocha
