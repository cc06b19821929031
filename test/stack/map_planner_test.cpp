#include "stack/map_planner.h"

#include <gtest/gtest.h>

#include <limits>

#include "planning/worlds.h"

namespace mocha {
namespace {

class MapPlannerTest : public ::testing::Test {
 protected:
  const OccupancyGrid open_ = free_grid({-2.0, -4.0}, {12.0, 4.0});
  const MapPlanner planner_{rover(), default_options()};
};

TEST_F(MapPlannerTest, PlansFromRestToTheGoalAndItsHeading) {
  const PlanResult plan = planner_.plan(open_, {{0.0, 0.0}, 0.5}, {{8.0, 1.0}, 1.0});
  ASSERT_EQ(plan.reason, PlanReason::kSolved) << plan.message;
  EXPECT_EQ(plan.motion.start_time(), 0.0);
  const MotionState start = plan.motion.at(0.0);
  EXPECT_TRUE(start.at_rest);
  EXPECT_LT(start.pose.position.norm(), 1e-9);
  EXPECT_NEAR(start.pose.yaw_rad, 0.5, 1e-9);
  const Pose end = plan.motion.end_pose();
  EXPECT_LT((end.position - Vector2(8.0, 1.0)).norm(), 1e-6);
  EXPECT_NEAR(end.yaw_rad, 1.0, 0.03);
}

TEST_F(MapPlannerTest, TheMapIsUnknownBeyondItsRimAndThereIsRoomToDrive) {
  OccupancyGrid walled = open_;
  fill_polygon(walled, {{{4.0, -4.0}, {4.2, -4.0}, {4.2, 4.0}, {4.0, 4.0}}},
               OccupancyGrid::kOccupied);
  const Goal goal{{8.0, 3.0}, {}};
  const PlanResult plan = planner_.plan(walled, {{0.0, 3.0}, 0.0}, goal);
  ASSERT_EQ(plan.reason, PlanReason::kSolved) << plan.message;
  EXPECT_GT(plan.motion.box().max().y(), 4.0);
}

TEST_F(MapPlannerTest, SaysWhyThereIsNoPlan) {
  OccupancyGrid grid = open_;
  fill_disc(grid, {0.0, 0.0}, 0.5, OccupancyGrid::kOccupied);
  const PlanResult plan = planner_.plan(grid, {}, {{8.0, 0.0}, {}});
  EXPECT_EQ(plan.reason, PlanReason::kStartOccupied);
  EXPECT_TRUE(plan.motion.empty());
}

TEST_F(MapPlannerTest, WhatIsNoGridOrNoPlaceIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Goal goal{{8.0, 0.0}, {}};
  EXPECT_THROW(planner_.plan({}, {}, goal), std::invalid_argument);
  EXPECT_THROW(planner_.plan(open_, {{nan, 0.0}, 0.0}, goal), std::invalid_argument);
  EXPECT_EQ(planner_.plan(open_, {}, {{nan, 0.0}, {}}).reason, PlanReason::kInvalidInput);
}

}  // namespace
}  // namespace mocha
