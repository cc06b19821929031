#include "planning/dodge.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "safety/certificate.h"
#include "trajectory/random_motion.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kOvershoot = 1.15;  // allowed over the acceleration limit

class DodgeTest : public ::testing::TestWithParam<const char*> {
 protected:
  const RobotModel robot_ = load_robot_model("config", GetParam());
  Motion winding(int seed, int direction) const {
    return within(random_drive(seed, 8, direction),
                  {0.9 * robot_.limits.max_speed, 0.7 * robot_.limits.max_acceleration,
                   0.7 * robot_.limits.max_yaw_rate},
                  kNow_s);
  }
};

TEST_P(DodgeTest, GoesOnFromTheMotionToRestAndMostlyWithinLimits) {
  MotionLimits limits = robot_.limits;
  limits.max_acceleration *= kOvershoot;
  int all = 0;
  int kept = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const Motion committed = winding(seed, seed % 2 == 0 ? 1 : -1);
    const double start_s = kNow_s + (0.2 + 0.03 * seed) * (committed.end_time() - kNow_s);
    const MotionState leaves = committed.at(start_s);
    for (const Motion& motion : dodges(committed, start_s, robot_.limits)) {
      EXPECT_EQ(motion.start_time(), start_s);
      const MotionState begins = motion.at(start_s + 1e-6);
      EXPECT_LT((begins.pose.position - leaves.pose.position).norm(), 1e-4);
      EXPECT_LT((begins.velocity - leaves.velocity).norm(), 1e-3);
      EXPECT_LT((begins.acceleration - leaves.acceleration).norm(), 1e-2);
      EXPECT_LT(std::abs(wrap_angle(begins.pose.yaw_rad - leaves.pose.yaw_rad)), 1e-3);
      EXPECT_TRUE(motion.at(motion.end_time() + 0.1).at_rest);
      EXPECT_LT(motion.end_time(), start_s + 6.0);
      ++all;
      kept += !check_limits(motion, limits, start_s);
    }
  }
  EXPECT_GE(all, 20 * 40);
  EXPECT_GE(kept, 0.8 * all);
}

TEST_P(DodgeTest, TurnsOffToBothSidesSoonerAndLater) {
  const double speed = 0.9 * robot_.limits.max_speed;
  const double acceleration = 0.5 * robot_.limits.max_acceleration;
  const Motion straight = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 12.0, speed, acceleration);
  double left_m = 0.0;
  double right_m = 0.0;
  double shortest_m = 1e9;
  double longest_m = 0.0;
  const double start_s = kNow_s + speed / acceleration + 1.0;
  const double from_x = straight.position(start_s).x();
  for (const Motion& motion : dodges(straight, start_s, robot_.limits)) {
    const Vector2 end = motion.end_pose().position;
    left_m = std::max(left_m, end.y());
    right_m = std::min(right_m, end.y());
    shortest_m = std::min(shortest_m, end.x() - from_x);
    longest_m = std::max(longest_m, end.x() - from_x);
  }
  const double brakes_m = 0.5 * speed * speed / robot_.limits.max_acceleration;
  EXPECT_GT(left_m, 0.3);
  EXPECT_NEAR(right_m, -left_m, 0.02);
  EXPECT_LT(shortest_m, 2.0 * brakes_m);
  EXPECT_GT(longest_m, shortest_m + 0.3);
}

TEST_P(DodgeTest, IsNoneAtRest) {
  const Motion straight = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 4.0, 0.5, 0.5);
  for (const double start_s : {kNow_s - 1.0, kNow_s + 0.05, straight.end_time() + 1.0})
    EXPECT_TRUE(dodges(straight, start_s, robot_.limits).empty());
}

INSTANTIATE_TEST_SUITE_P(Robots, DodgeTest, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
