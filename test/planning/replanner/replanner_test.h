#pragma once

#include <gtest/gtest.h>

#include "planning/closed_loop.h"

namespace mocha {

/// A replanner in steps that the test makes, of a robot that is where its motion says.
class ReplannerTest : public ::testing::Test {
 protected:
  static constexpr double kNow_s = 1.7e9;

  static RobotState state(const Motion& motion, double now_s) {
    const MotionState at = motion.at(now_s);
    return {now_s, at.pose, {at.speed, at.yaw_rate}};
  }

  LocalReplanner::Output step_on_track(double now_s) {
    return replanner_.step(now_s, state(replanner_.committed(), now_s), scene_);
  }

  /// A wall from side to side.
  void block(double from_x) {
    OccupancyGrid grid = open_;
    fill_box(grid, {from_x, -3.0}, {from_x + 0.5, 3.0});
    scene_ = scene_of(grid);
  }

  /// A plan from rest, along x.
  static Motion plan_from(double start_s) {
    return straight_drive(start_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  }

  const RobotModel robot_ = rover();
  const LocalReplannerOptions options_ = default_replanner_options(robot_);
  LocalReplanner replanner_{robot_, options_, default_local_options()};
  const OccupancyGrid open_ = free_grid({-2.0, -3.0}, {12.0, 3.0});
  LocalScene scene_ = scene_of(open_);
  const Motion ahead_ = plan_from(kNow_s);
};

}  // namespace mocha
