#include <algorithm>
#include <limits>
#include <memory>
#include <variant>

#include "planning/candidates/peer_discs.h"
#include "planning/global/global_planner_fixture.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

class DeadEndTest : public GlobalPlannerTest {
 protected:
  /// A corridor closed at its end; too narrow to turn in for a robot with a long footprint.
  OccupancyGrid dead_end() const {
    OccupancyGrid grid = open_;
    fill_box(grid, {0.0, 0.42}, {4.0, 0.62});
    fill_box(grid, {0.0, -0.62}, {4.0, -0.42});
    fill_box(grid, {4.0, -0.62}, {4.2, 0.62});
    return grid;
  }

  RobotModel long_robot() const {
    RobotModel robot = robot_;
    robot.footprint = Footprint::rectangle(1.0, 0.4);
    return robot;
  }
};

TEST_F(DeadEndTest, BacksOutOfADeadEnd) {
  RobotModel robot = long_robot();
  const PlanQuery query = from_standing({3.2, 0.0}, 0.0, {8.0, 0.0});
  const PlanningScene scene{static_map_of(dead_end()), {}};
  const PlanResult backs_out = GlobalPlanner(robot, default_options()).plan(query, scene);
  ASSERT_EQ(backs_out.reason, PlanReason::kSolved) << backs_out.message;
  EXPECT_EQ(std::get<DrivePhase>(backs_out.motion.phases().front()).direction, -1);
  EXPECT_FALSE(check_clearance(backs_out.motion, robot.footprint, scene.static_map->field(),
                               MarginBudget::of(robot).static_margin(), kStart_s));
  robot.limits.can_reverse = false;
  const PlanResult stuck = GlobalPlanner(robot, default_options()).plan(query, scene);
  EXPECT_NE(stuck.reason, PlanReason::kSolved);
  EXPECT_TRUE(stuck.motion.empty());
}

/// The nearest place to turn in is beside the team-mate; farther up there is another.
TEST_F(DeadEndTest, BacksOutOfADeadEndClearOfATeamMateBeforeIt) {
  const RobotModel robot = long_robot();
  const PlanQuery query = from_standing({3.2, 0.0}, 0.0, {8.0, 0.0});
  const auto stand = std::make_shared<const Motion>(standing(kStart_s - 5.0, {-0.9, -1.1}, 0.0));
  const auto peer = std::make_shared<PeerObstacle>("ugv2", stand, 0.3, test::kRoverBraking);
  const BlockedDisc disc = peer_keep_out(*peer, kStart_s, robot, 0.0);
  const auto nearest_m = [&](const Motion& motion) {
    double apart_m = std::numeric_limits<double>::infinity();
    for (double t = kStart_s; t < motion.end_time(); t += 0.05)
      apart_m = std::min(apart_m, (motion.position(t) - disc.centre).norm());
    return apart_m;
  };
  const GlobalPlanner planner(robot, default_options());
  const auto map = static_map_of(dead_end());
  const PlanResult alone = planner.plan(query, {map, {}});
  ASSERT_EQ(alone.reason, PlanReason::kSolved) << alone.message;
  ASSERT_LT(nearest_m(alone.motion), disc.radius_m);
  const PlanResult result = planner.plan(query, {map, {peer}});
  ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
  EXPECT_GT(nearest_m(result.motion), disc.radius_m);
}

TEST_F(DeadEndTest, StaysInADeadEndThatATeamMateCloses) {
  const RobotModel robot = long_robot();
  const PlanQuery query = from_standing({3.2, 0.0}, 0.0, {8.0, 0.0});
  const auto stand = std::make_shared<const Motion>(standing(kStart_s - 5.0, {0.5, 0.0}, 0.0));
  const auto peer = std::make_shared<PeerObstacle>("ugv2", stand, 0.3, test::kRoverBraking);
  const PlanResult result =
      GlobalPlanner(robot, default_options()).plan(query, {static_map_of(dead_end()), {peer}});
  EXPECT_EQ(result.reason, PlanReason::kPeerConflict) << result.message;
  EXPECT_TRUE(result.motion.empty());
}

}  // namespace
}  // namespace mocha
