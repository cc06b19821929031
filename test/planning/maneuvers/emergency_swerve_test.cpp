#include "planning/maneuvers/emergency_swerve.h"

#include <gtest/gtest.h>

#include "planning/maneuver_test.h"
#include "trajectory/random_motion.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class EmergencySwerveTest : public ManeuverTest, public ::testing::WithParamInterface<const char*> {
 protected:
  EmergencySwerveTest() : ManeuverTest(GetParam()) {}

  Motion winding(int seed, int direction) const {
    return within(random_drive(seed, 8, direction),
                  {0.9 * robot_.limits.max_speed, 0.7 * robot_.limits.max_acceleration,
                   0.7 * robot_.limits.max_yaw_rate},
                  kNow_s);
  }

  const OccupancyGrid grid_ = free_grid({-6.0, -6.0}, {20.0, 6.0});
  const LocalScene open_ = scene_of(grid_);
};

TEST_P(EmergencySwerveTest, GoesOnFromTheMotionToRestAndMostlyWithinLimits) {
  int all = 0;
  int kept = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const Motion committed = winding(seed, seed % 2 == 0 ? 1 : -1);
    const double now_s = kNow_s + (0.2 + 0.03 * seed) * (committed.end_time() - kNow_s);
    const ManeuverStart start = start_of(committed, open_, now_s);
    const double join_s = start.emergency_s;
    const MotionState leaves = committed.at(join_s);
    for (const Maneuver& maneuver : emergency_swerves(start)) {
      const Motion& motion = maneuver.motion;
      EXPECT_TRUE(maneuver.at_once);
      EXPECT_EQ(maneuver.join_s, join_s);
      EXPECT_EQ(motion.start_time(), join_s);
      const MotionState begins = motion.at(join_s + 1e-6);
      EXPECT_LT((begins.pose.position - leaves.pose.position).norm(), 1e-4);
      EXPECT_LT((begins.velocity - leaves.velocity).norm(), 1e-3);
      EXPECT_LT((begins.acceleration - leaves.acceleration).norm(), 1e-2);
      EXPECT_LT(std::abs(wrap_angle(begins.pose.yaw_rad - leaves.pose.yaw_rad)), 1e-3);
      EXPECT_TRUE(motion.at(motion.end_time() + 0.1).at_rest);
      EXPECT_LT(motion.end_time(), join_s + 6.0);
      ++all;
      kept += !check_limits(motion, robot_.emergency_limits(), join_s);
    }
  }
  EXPECT_GE(all, 20 * 40);
  EXPECT_GE(kept, 0.8 * all);
}

TEST_P(EmergencySwerveTest, TurnsOffToBothSidesSoonerAndLater) {
  const double speed = 0.9 * robot_.limits.max_speed;
  const double acceleration = 0.5 * robot_.limits.max_acceleration;
  const Motion straight = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 12.0, speed, acceleration);
  double left_m = 0.0;
  double right_m = 0.0;
  double shortest_m = 1e9;
  double longest_m = 0.0;
  const ManeuverStart start = start_of(straight, open_, kNow_s + speed / acceleration + 1.0);
  const double from_x = straight.position(start.emergency_s).x();
  for (const Maneuver& maneuver : emergency_swerves(start)) {
    const Vector2 end = maneuver.motion.end_pose().position;
    left_m = std::max(left_m, end.y());
    right_m = std::min(right_m, end.y());
    shortest_m = std::min(shortest_m, end.x() - from_x);
    longest_m = std::max(longest_m, end.x() - from_x);
  }
  const double brakes_m = 0.5 * speed * speed / robot_.hard_braking().deceleration();
  EXPECT_GT(left_m, 0.3);
  EXPECT_NEAR(right_m, -left_m, 0.02);
  EXPECT_LT(shortest_m, 2.0 * brakes_m);
  EXPECT_GT(longest_m, shortest_m + 0.3);
}

TEST_P(EmergencySwerveTest, IsNoneAtRest) {
  const Motion straight = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 4.0, 0.5, 0.5);
  for (const double now_s : {kNow_s - 1.0, kNow_s - 0.05, straight.end_time() + 1.0})
    EXPECT_TRUE(emergency_swerves(start_of(straight, open_, now_s)).empty());
}

TEST_P(EmergencySwerveTest, IsNoneNearAPeer) {
  const Motion straight = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 12.0, 0.9, 0.5);
  const double now_s = kNow_s + 4.0;
  for (const auto& [apart_m, is_near] : {std::pair{4.0, true}, std::pair{6.0, false}}) {
    LocalScene scene = open_;
    const Vector2 place = straight.position(now_s) + Vector2(0.0, apart_m);
    scene.peers = {peer(standing(kNow_s - 9.0, place, 0.0))};
    EXPECT_EQ(emergency_swerves(start_of(straight, scene, now_s)).empty(), is_near);
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, EmergencySwerveTest, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
