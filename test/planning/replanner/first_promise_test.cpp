#include <gtest/gtest.h>

#include "planning/replanner/local_replanner.h"
#include "planning/worlds.h"
#include "trajectory/rover_braking.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

/// The first motion in force, a stand, begins only later than the next proposal is made. What is
/// proposed still follows the plan at the plan's own times.
TEST(FirstPromise, KeepsTheTimesOfThePlan) {
  const RobotModel robot = rover();
  const OccupancyGrid open = free_grid({-2.0, -3.0}, {12.0, 3.0});
  const LocalScene scene = scene_of(open);
  const Motion plan = straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  LocalReplanner replanner(robot, {0.3, 0.1, 4.0, 1.0, 0.6, 0.09, 0.09, 0.5, 3.0, 50.0},
                           default_local_options());
  replanner.set_committed(1, standing(kNow_s + 0.3, {0.0, 0.0}, 0.0));
  replanner.set_plan(plan);

  const RobotState here{kNow_s + 0.1, {{0.0, 0.0}, 0.0}, {0.0, 0.0}};
  const auto output = replanner.step(kNow_s + 0.1, here, scene);
  ASSERT_TRUE(output.proposal) << output.message;
  const Motion& proposed = output.proposal->motion;
  EXPECT_NEAR(proposed.start_time(), plan.start_time(), 1e-6);
  EXPECT_LT(proposed.at(proposed.start_time()).velocity.norm(), 1e-6);
  for (double t = kNow_s + 0.5; t < kNow_s + 4.0; t += 0.1) {
    EXPECT_LT((proposed.at(t).pose.position - plan.at(t).pose.position).norm(), 1e-5) << t - kNow_s;
  }
}

/// Where it stands is no wish: it binds at once, whatever the others have promised meanwhile. Else
/// they would not know of the robot, and drive through it.
TEST(FirstPromise, IsToStandAndBindsAtOnce) {
  const RobotModel robot = rover();
  const OccupancyGrid open = free_grid({-2.0, -3.0}, {12.0, 3.0});
  LocalScene scene = scene_of(open);
  const auto through_it = std::make_shared<const Motion>(
      straight_drive(kNow_s, {1.0, -3.0}, M_PI / 2.0, 6.0, 0.9, 0.5));
  scene.peers = {std::make_shared<PeerObstacle>("ugv2", through_it, 0.3, test::kRoverBraking)};
  LocalReplanner replanner(robot, {0.3, 0.1, 4.0, 1.0, 0.6, 0.09, 0.09, 0.5, 3.0, 50.0},
                           default_local_options());
  const RobotState here{kNow_s, {{1.0, 0.0}, 0.3}, {0.0, 0.0}};
  const auto output = replanner.step(kNow_s, here, scene);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);
  EXPECT_EQ(output.proposal->motion.start_time(), kNow_s);
  EXPECT_LT((output.proposal->motion.end_pose().position - here.pose.position).norm(), 1e-5);
  EXPECT_EQ(output.proposal->motion.length_m(), 0.0);
}

/// A broadcaster that was started again knows only what was settled since: a motion that begins
/// ahead of the moving robot. Until then the robot is not off it.
TEST(FirstPromise, IsNotHeldAgainstARobotThatIsOnItsWayThere) {
  const RobotModel robot = rover();
  const OccupancyGrid open = free_grid({-2.0, -3.0}, {12.0, 3.0});
  const LocalScene scene = scene_of(open);
  const Motion plan = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  LocalReplanner replanner(robot, {0.3, 0.1, 4.0, 1.0, 0.6, 0.09, 0.09, 0.5, 3.0, 50.0},
                           default_local_options());
  replanner.set_plan(plan);
  replanner.set_committed(7, rest_of(plan, kNow_s + 4.0));

  const MotionState now = plan.at(kNow_s + 3.75);
  const RobotState here{kNow_s + 3.75, now.pose, {now.speed, now.yaw_rate}};
  ASSERT_GT(now.speed, 0.5);
  const auto output = replanner.step(kNow_s + 3.75, here, scene);
  EXPECT_FALSE(output.proposal && output.proposal->emergency) << output.message;
  EXPECT_TRUE(output.renew_lease);
}

}  // namespace
}  // namespace mocha
