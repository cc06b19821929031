#include "control/robot_state.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocha {
namespace {

RobotState moving(double speed, double yaw_rate) {
  RobotState state;
  state.twist = {speed, yaw_rate};
  return state;
}

TEST(RobotState, StandsWhereItNeitherDrivesNorTurns) {
  EXPECT_TRUE(stands(moving(0.0, 0.0)));
  EXPECT_TRUE(stands(moving(-0.02, 0.03)));  // noise of odometry
  EXPECT_FALSE(stands(moving(0.05, 0.0)));
  EXPECT_FALSE(stands(moving(-0.05, 0.0)));
  EXPECT_FALSE(stands(moving(0.0, 0.1)));
  EXPECT_FALSE(stands(moving(0.0, -0.1)));
}

TEST(RobotState, IsPredictedAlongAnArc) {
  RobotState state = moving(1.0, M_PI / 2.0);
  state.stamp_s = 5.0;
  const Pose later = predict(state, 6.0);
  EXPECT_NEAR(later.position.x(), 2.0 / M_PI, 1e-12);
  EXPECT_NEAR(later.position.y(), 2.0 / M_PI, 1e-12);
  EXPECT_NEAR(later.yaw_rad, M_PI / 2.0, 1e-12);
}

}  // namespace
}  // namespace mocha
