#include "planning/maneuvers/back_out.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planning/worlds.h"
#include "safety/certificate.h"

namespace mocha {
namespace {

const MotionLimits kLimits = rover().limits;

std::vector<Vector2> straight_trail(double length_m) {
  std::vector<Vector2> trail;
  for (double x = -length_m; x <= 0.0; x += 0.05) trail.push_back({x, 0.0});
  return trail;
}

TEST(BackOut, DrivesBackwardAlongTheTrail) {
  const auto motion = back_out_along(straight_trail(3.0), {{0.0, 0.0}, 0.0}, 7.0, 1.0, kLimits);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->start_time(), 7.0);
  EXPECT_NEAR(motion->end_pose().position.x(), -1.0, 0.21);
  EXPECT_NEAR(motion->end_pose().yaw_rad, 0.0, 1e-6);
  for (double t = 7.0; t < motion->end_time(); t += 0.05) {
    EXPECT_NEAR(motion->at(t).pose.position.y(), 0.0, 1e-6);
    EXPECT_LE(motion->at(t).speed, 1e-9);
  }
}

TEST(BackOut, FollowsABentTrailWithinTheLimits) {
  std::vector<Vector2> trail;
  for (double angle = -M_PI / 2; angle <= 0.0; angle += 0.02) {
    trail.push_back({2.0 * std::sin(angle), 2.0 - 2.0 * std::cos(angle)});
  }
  const auto motion = back_out_along(trail, {{0.0, 0.0}, 0.0}, 0.0, 2.0, kLimits);
  ASSERT_TRUE(motion);
  EXPECT_FALSE(check_limits(*motion, kLimits, 0.0));
  for (double t = 0.0; t < motion->end_time(); t += 0.05) {
    EXPECT_NEAR((motion->at(t).pose.position - Vector2(0.0, 2.0)).norm(), 2.0, 0.03);
  }
}

TEST(BackOut, DrivesAWaveringTrailMoreSlowly) {
  std::vector<Vector2> trail;
  for (double x = -3.0; x <= 0.0; x += 0.2) {
    trail.push_back({x, std::lround(x / 0.2) % 2 == 0 ? 0.01 : -0.01});
  }
  const Pose pose{{0.1, 0.0}, 0.0};
  MotionLimits limits = kLimits;
  limits.max_yaw_rate = 0.2;
  const auto motion = back_out_along(trail, pose, 0.0, 1.0, limits);
  ASSERT_TRUE(motion);
  EXPECT_FALSE(check_limits(*motion, limits, 0.0));
  const auto brisk = back_out_along(trail, pose, 0.0, 1.0, kLimits);
  ASSERT_TRUE(brisk);
  EXPECT_GT(motion->end_time(), 1.1 * brisk->end_time());
}

TEST(BackOut, IsNothingWithoutATrailOrWhereTheRobotDidNotComeFromBehind) {
  const auto trail = straight_trail(3.0);
  EXPECT_FALSE(back_out_along({}, {{0.0, 0.0}, 0.0}, 0.0, 1.0, kLimits));
  EXPECT_FALSE(back_out_along({{0.0, 0.0}}, {{0.0, 0.0}, 0.0}, 0.0, 1.0, kLimits));
  EXPECT_FALSE(back_out_along(trail, {{0.0, 0.0}, M_PI}, 0.0, 1.0, kLimits));
  EXPECT_FALSE(back_out_along(trail, {{0.0, 0.0}, M_PI / 2}, 0.0, 1.0, kLimits));
}

TEST(BackOut, IsNothingForARobotThatCannotReverse) {
  MotionLimits limits = kLimits;
  limits.can_reverse = false;
  EXPECT_FALSE(back_out_along(straight_trail(3.0), {{0.0, 0.0}, 0.0}, 0.0, 1.0, limits));
}

}  // namespace
}  // namespace mocha
