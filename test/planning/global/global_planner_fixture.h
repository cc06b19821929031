#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planning/global/global_planner.h"
#include "planning/worlds.h"
#include "safety/certificate.h"
#include "world/margin_budget.h"

namespace mocha {

/// A rover on open ground.
class GlobalPlannerTest : public ::testing::Test {
 protected:
  static constexpr double kStart_s = 1.7e9 + 0.25;  // what ROS time looks like

  PlanQuery from_standing(const Vector2& start, double yaw_rad, const Vector2& goal) const {
    PlanQuery query;
    query.start_time_s = kStart_s;
    query.committed = standing(kStart_s - 1.0, start, yaw_rad);
    query.goal = goal;
    return query;
  }

  PlanResult plan(const PlanQuery& query, const OccupancyGrid& grid) const {
    return planner_.plan(query, {static_map_of(grid), {}});
  }

  void expect_certified(const PlanResult& result, const PlanQuery& query,
                        const OccupancyGrid& grid) const {
    ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
    const auto field = occupied_field(grid);
    const SpeedMargin margin = MarginBudget::of(robot_).static_margin();
    EXPECT_FALSE(result.violation) << describe(result.violation);
    const Violation limits = check_limits(result.motion, robot_.limits, query.start_time_s);
    EXPECT_FALSE(limits) << describe(limits);
    const Violation clearance =
        check_clearance(result.motion, robot_.footprint, *field, margin, query.start_time_s);
    EXPECT_FALSE(clearance) << describe(clearance);
    EXPECT_EQ(result.motion.start_time(), query.start_time_s);
    ASSERT_FALSE(result.candidates.empty());
    EXPECT_EQ(std::count_if(result.candidates.begin(), result.candidates.end(),
                            [](const auto& candidate) { return candidate.selected; }),
              1);
  }

  /// The motion must go on from the committed one in everything that a base cannot change at once.
  void expect_joined(const PlanResult& result, const PlanQuery& query) const {
    const MotionState before = query.committed.at(query.start_time_s);
    const MotionState after = result.motion.at(query.start_time_s);
    EXPECT_LT((before.pose.position - after.pose.position).norm(), 1e-6);
    EXPECT_LT(std::abs(wrap_angle(before.pose.yaw_rad - after.pose.yaw_rad)), 1e-4);
    EXPECT_LT((before.velocity - after.velocity).norm(), 1e-5);
    if (before.at_rest) return;
    EXPECT_LT((before.acceleration - after.acceleration).norm(), 1e-4);
  }

  const RobotModel robot_ = rover();
  const GlobalPlanner planner_{robot_, default_options()};
  const OccupancyGrid open_ = free_grid({-2.0, -4.0}, {12.0, 4.0});
};

}  // namespace mocha
