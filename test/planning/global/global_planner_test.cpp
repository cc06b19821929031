#include "planning/global/global_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planning/candidates/peer_discs.h"
#include "planning/worlds.h"
#include "safety/certificate.h"
#include "trajectory/rover_braking.h"
#include "trajectory/stopping.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kStart_s = 1.7e9 + 0.25;  // what ROS time looks like

class GlobalPlannerTest : public ::testing::Test {
 protected:
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

  const RobotModel robot_ = rover();
  const GlobalPlanner planner_{robot_, default_options()};
  const OccupancyGrid open_ = free_grid({-2.0, -4.0}, {12.0, 4.0});
};

TEST_F(GlobalPlannerTest, DrivesStraightAhead) {
  const PlanQuery query = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
  const PlanResult result = plan(query, open_);
  expect_certified(result, query, open_);
  expect_joined(result, query);
  EXPECT_EQ(result.motion.phases().size(), 1u);
  EXPECT_LT((result.motion.end_pose().position - query.goal).norm(), 1e-6);
  const double kinematic_s =
      8.0 / robot_.limits.max_speed + robot_.limits.max_speed / robot_.limits.max_acceleration;
  EXPECT_LT(result.motion.end_time() - kStart_s, 1.25 * kinematic_s);
  EXPECT_NEAR(result.motion.length_m(), 8.0, 0.01);
}

TEST_F(GlobalPlannerTest, DrivesAroundAWall) {
  OccupancyGrid grid = open_;
  fill_box(grid, {4.0, -4.0}, {4.2, 2.0});
  const PlanQuery query = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
  const PlanResult result = plan(query, grid);
  expect_certified(result, query, grid);
  EXPECT_LT((result.motion.end_pose().position - query.goal).norm(), 1e-6);
  EXPECT_LT(result.motion.length_m(), 1.25 * (std::hypot(4.0, 2.35) + std::hypot(3.8, 2.35) + 0.2));
}

TEST_F(GlobalPlannerTest, TurnsInPlaceFirstWhereTheHeadingDoesNotFit) {
  const PlanQuery query = from_standing({0.0, 0.0}, M_PI / 2.0 + 0.3, {8.0, 0.0});
  const PlanResult result = plan(query, open_);
  expect_certified(result, query, open_);
  expect_joined(result, query);
  ASSERT_EQ(result.motion.phases().size(), 2u);
  const auto* turn = std::get_if<TurnPhase>(&result.motion.phases()[0]);
  ASSERT_NE(turn, nullptr);
  EXPECT_NEAR(turn->yaw_change_rad, -(M_PI / 2.0 + 0.3), 0.05);
}

TEST_F(GlobalPlannerTest, TurnsTheShorterWay) {
  const PlanQuery query = from_standing({8.0, 0.5}, -3.0, {0.0, 0.5});
  const PlanResult result = plan(query, open_);
  expect_certified(result, query, open_);
  EXPECT_LT(result.motion.end_time() - kStart_s, 14.0);
}

TEST_F(GlobalPlannerTest, MovingStartIsJoinedInPositionVelocityAndAcceleration) {
  for (const double after_s : {0.3, 1.0, 2.5, 6.0, 8.9}) {
    PlanQuery query;
    query.committed = straight_drive(kStart_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
    query.start_time_s = kStart_s + after_s;
    query.goal = {9.0, 2.0};
    ASSERT_FALSE(query.committed.at(query.start_time_s).at_rest);
    const PlanResult result = plan(query, open_);
    expect_certified(result, query, open_);
    expect_joined(result, query);
    EXPECT_LT((result.motion.end_pose().position - query.goal).norm(), 1e-6);
  }
}

TEST_F(GlobalPlannerTest, BrakesFirstWhereTheGoalLiesBehind) {
  PlanQuery query;
  query.committed = straight_drive(kStart_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  query.start_time_s = kStart_s + 4.0;
  query.goal = {-1.0, 0.0};
  const PlanResult result = plan(query, open_);
  expect_certified(result, query, open_);
  expect_joined(result, query);
  ASSERT_EQ(result.motion.phases().size(), 3u);  // brake, turn, drive
  EXPECT_TRUE(std::holds_alternative<TurnPhase>(result.motion.phases()[1]));
}

TEST_F(GlobalPlannerTest, ARobotThatCannotReverseTurnsToAGoalBehind) {
  RobotModel robot = robot_;
  robot.limits.can_reverse = false;
  const GlobalPlanner planner(robot, default_options());
  const PlanQuery query = from_standing({8.0, 0.0}, 0.0, {0.0, 0.0});
  const PlanResult result = planner.plan(query, {static_map_of(open_), {}});
  expect_certified(result, query, open_);
  const Violation limits = check_limits(result.motion, robot.limits, kStart_s);
  EXPECT_FALSE(limits) << describe(limits);
  ASSERT_EQ(result.motion.phases().size(), 2u);
  EXPECT_TRUE(std::holds_alternative<TurnPhase>(result.motion.phases()[0]));
  EXPECT_EQ(std::get<DrivePhase>(result.motion.phases()[1]).direction, 1);
}

TEST_F(GlobalPlannerTest, ReachesTheHeadingAskedFor) {
  for (const double yaw_rad : {0.0, 1.5, M_PI, -2.0}) {
    PlanQuery query = from_standing({0.0, 0.0}, 0.4, {5.0, 1.0});
    query.goal_yaw_rad = yaw_rad;
    const PlanResult result = plan(query, open_);
    expect_certified(result, query, open_);
    EXPECT_LT(std::abs(wrap_angle(result.motion.end_pose().yaw_rad - yaw_rad)), 0.03) << yaw_rad;
  }
}

TEST_F(GlobalPlannerTest, AtTheGoalItOnlyTurns) {
  PlanQuery query = from_standing({1.0, 1.0}, 0.0, {1.01, 1.0});
  query.goal_yaw_rad = 2.0;
  const PlanResult turn = plan(query, open_);
  ASSERT_EQ(turn.reason, PlanReason::kSolved) << turn.message;
  EXPECT_EQ(turn.motion.length_m(), 0.0);
  EXPECT_NEAR(turn.motion.end_pose().yaw_rad, 2.0, 1e-9);
  EXPECT_FALSE(check_limits(turn.motion, robot_.limits, kStart_s));
  query.goal_yaw_rad.reset();
  const PlanResult stand = plan(query, open_);
  ASSERT_EQ(stand.reason, PlanReason::kSolved);
  EXPECT_EQ(stand.motion.length_m(), 0.0);
}

TEST_F(GlobalPlannerTest, ShortWaysAreDrivenToo) {
  for (const double length_m : {0.031, 0.06, 0.12, 0.3, 0.6}) {
    for (const double yaw_rad : {0.0, 2.0}) {
      const PlanQuery query = from_standing({0.0, 0.0}, yaw_rad, {length_m, 0.0});
      const PlanResult result = plan(query, open_);
      expect_certified(result, query, open_);
    }
  }
}

TEST_F(GlobalPlannerTest, ShortWaysBesideAWallAreDrivenToo) {
  OccupancyGrid grid = open_;
  fill_box(grid, {1.0, -4.0}, {1.2, 4.0});
  for (const double y : {0.031, 0.04, 0.1, 0.5}) {
    const PlanQuery query = from_standing({0.55, 0.0}, M_PI / 2.0, {0.55, y});
    const PlanResult result = plan(query, grid);
    expect_certified(result, query, grid);
  }
}

TEST_F(GlobalPlannerTest, OccupiedGoalIsReplacedByTheNearestFreePlace) {
  OccupancyGrid grid = open_;
  fill_disc(grid, {8.0, 0.0}, 0.15, OccupancyGrid::kOccupied);
  PlannerOptions options = default_options();
  options.goal_search_radius_m = 1.0;
  const GlobalPlanner planner(robot_, options);
  const PlanQuery query = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
  const PlanResult result = planner.plan(query, {static_map_of(grid), {}});
  expect_certified(result, query, grid);
  const double off_m = (result.motion.end_pose().position - query.goal).norm();
  EXPECT_LT(off_m, 0.15 + 0.3 + MarginBudget::of(robot_).static_margin_m() + 0.15);
  EXPECT_GT(off_m, 0.45);
}

TEST_F(GlobalPlannerTest, GoalDeepInAWallIsOccupied) {
  OccupancyGrid grid = open_;
  fill_disc(grid, {8.0, 0.0}, 1.5, OccupancyGrid::kOccupied);
  const PlanResult result = plan(from_standing({0.0, 0.0}, 0.0, {8.0, 0.0}), grid);
  EXPECT_EQ(result.reason, PlanReason::kGoalOccupied);
  EXPECT_TRUE(result.motion.empty());
  EXPECT_NE(result.message.find("(8.00, 0.00)"), std::string::npos) << result.message;
}

TEST_F(GlobalPlannerTest, SaysThatThereIsNoWay) {
  OccupancyGrid grid = open_;
  fill_box(grid, {4.0, -4.0}, {4.2, 4.0});
  // The border of the map is open: close it as well.
  fill_box(grid, {-2.0, 3.8}, {12.0, 4.0});
  fill_box(grid, {-2.0, -4.0}, {12.0, -3.8});
  const PlanResult result = plan(from_standing({0.0, 0.0}, 0.0, {8.0, 0.0}), grid);
  EXPECT_EQ(result.reason, PlanReason::kNoPath);
  EXPECT_TRUE(result.motion.empty());
  EXPECT_TRUE(result.candidates.empty());
  EXPECT_NE(result.message.find("no path"), std::string::npos) << result.message;
  // Before the wall, by its margin.
  EXPECT_NE(result.message.find("nearest place in reach is (3."), std::string::npos)
      << result.message;
}

TEST_F(GlobalPlannerTest, AnEnclosedRobotStandsAndSaysSo) {
  OccupancyGrid grid = open_;
  fill_disc(grid, {0.0, 0.0}, 1.2, OccupancyGrid::kOccupied);
  fill_disc(grid, {0.0, 0.0}, 0.9, OccupancyGrid::kFree);
  const PlanResult result = plan(from_standing({0.0, 0.0}, 0.0, {8.0, 0.0}), grid);
  EXPECT_EQ(result.reason, PlanReason::kNoPath);
  EXPECT_TRUE(result.motion.empty());
}

TEST_F(GlobalPlannerTest, StandingInAWallIsNamed) {
  OccupancyGrid grid = open_;
  fill_disc(grid, {0.0, 0.0}, 0.6, OccupancyGrid::kOccupied);
  const PlanResult result = plan(from_standing({0.0, 0.0}, 0.0, {8.0, 0.0}), grid);
  EXPECT_EQ(result.reason, PlanReason::kStartOccupied) << result.message;
  EXPECT_TRUE(result.motion.empty());
}

TEST_F(GlobalPlannerTest, BacksOutOfADeadEnd) {
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
TEST_F(GlobalPlannerTest, BacksOutOfADeadEndClearOfATeamMateBeforeIt) {
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

TEST_F(GlobalPlannerTest, StaysInADeadEndThatATeamMateCloses) {
  const RobotModel robot = long_robot();
  const PlanQuery query = from_standing({3.2, 0.0}, 0.0, {8.0, 0.0});
  const auto stand = std::make_shared<const Motion>(standing(kStart_s - 5.0, {0.5, 0.0}, 0.0));
  const auto peer = std::make_shared<PeerObstacle>("ugv2", stand, 0.3, test::kRoverBraking);
  const PlanResult result =
      GlobalPlanner(robot, default_options()).plan(query, {static_map_of(dead_end()), {peer}});
  EXPECT_EQ(result.reason, PlanReason::kPeerConflict) << result.message;
  EXPECT_TRUE(result.motion.empty());
}

TEST_F(GlobalPlannerTest, GoesRoundAStandingPeer) {
  const PlanQuery query = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
  const auto stand = std::make_shared<const Motion>(standing(kStart_s - 5.0, {4.0, 0.0}, 0.0));
  const auto peer = std::make_shared<PeerObstacle>("ugv2", stand, 0.3, test::kRoverBraking);
  const PlanResult result = planner_.plan(query, {static_map_of(open_), {peer}});
  expect_certified(result, query, open_);
  const double apart_m = robot_.peer_clearance_m + MarginBudget::of(robot_).peer_margin_m();
  const Violation violation = check_separation(result.motion, 0.3, *peer, apart_m, kStart_s);
  EXPECT_FALSE(violation) << describe(violation);
}

TEST_F(GlobalPlannerTest, KeepsApartFromAPeerThatCrosses) {
  const PlanQuery query = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
  const auto crossing = std::make_shared<const Motion>(
      straight_drive(kStart_s + 1.5, {4.0, -3.0}, M_PI / 2.0, 6.0, 0.9, 0.5));
  const auto peer = std::make_shared<PeerObstacle>("ugv2", crossing, 0.3, test::kRoverBraking);
  const double apart_m = robot_.peer_clearance_m + MarginBudget::of(robot_).peer_margin_m();
  ASSERT_TRUE(check_separation(plan(query, open_).motion, 0.3, *peer, apart_m, kStart_s));
  const PlanResult result = planner_.plan(query, {static_map_of(open_), {peer}});
  expect_certified(result, query, open_);
  const Violation violation = check_separation(result.motion, 0.3, *peer, apart_m, kStart_s);
  EXPECT_FALSE(violation) << describe(violation);
}

TEST_F(GlobalPlannerTest, WhoStandsTooCloseToAWallMayLeave) {
  OccupancyGrid grid = open_;
  fill_box(grid, {-2.0, 0.34}, {12.0, 0.5});  // 4 cm from the body, 10 are required
  const PlanQuery query = from_standing({0.0, 0.0}, -0.3, {6.0, -2.0});
  const PlanResult result = plan(query, grid);
  ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
  const auto field = occupied_field(grid);
  EXPECT_FALSE(check_clearance(result.motion, robot_.footprint, *field, 0.03, kStart_s));
  EXPECT_FALSE(check_clearance(result.motion, robot_.footprint, *field,
                               MarginBudget::of(robot_).static_margin(), kStart_s + 2.0));
}

TEST_F(GlobalPlannerTest, ATurnAtTheGoalThatCannotBeProvedIsNotHandedOut) {
  OccupancyGrid grid = open_;
  fill_box(grid, {-2.0, 0.20}, {12.0, 0.5});  // inside of the body
  const RobotModel robot = jackal();
  const GlobalPlanner planner(robot, default_options());
  PlanQuery query = from_standing({0.0, 0.0}, 0.0, {0.01, 0.0});
  query.goal_yaw_rad = M_PI / 2.0;  // its nose would be in the wall
  const PlanResult result = planner.plan(query, {static_map_of(grid), {}});
  EXPECT_EQ(result.reason, PlanReason::kNotCertified);
  EXPECT_TRUE(result.motion.empty());
  EXPECT_FALSE(result.message.empty());
}

TEST_F(GlobalPlannerTest, InvalidInputIsNamedAndNothingMoves) {
  const PlanQuery good = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
  const auto expect_reason = [&](const PlanQuery& query, PlanReason reason) {
    const PlanResult result = plan(query, open_);
    EXPECT_EQ(result.reason, reason) << result.message;
    EXPECT_TRUE(result.motion.empty());
    EXPECT_FALSE(result.message.empty());
  };
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    PlanQuery query = good;
    query.goal.y() = bad;
    expect_reason(query, PlanReason::kInvalidInput);
    query = good;
    query.goal_yaw_rad = bad;
    expect_reason(query, PlanReason::kInvalidInput);
    query = good;
    query.start_time_s = bad;
    expect_reason(query, PlanReason::kInvalidInput);
  }
  PlanQuery query = good;
  query.committed = Motion();
  expect_reason(query, PlanReason::kNoPose);
  EXPECT_EQ(planner_.plan(good, {}).reason, PlanReason::kNoMap);
}

TEST_F(GlobalPlannerTest, HugeNumbersAreNoWay) {
  for (const double huge : {1e6, 1e9, 1e300, -1e300}) {
    PlanQuery query = from_standing({0.0, 0.0}, 0.0, {huge, 0.0});
    EXPECT_EQ(plan(query, open_).reason, PlanReason::kNoPath) << huge;
    query = from_standing({huge, 0.0}, 0.0, {8.0, 0.0});
    EXPECT_TRUE(plan(query, open_).motion.empty()) << huge;
    query = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
    query.goal_yaw_rad = huge;
    plan(query, open_);
  }
}

TEST_F(GlobalPlannerTest, AMapFarFromItsOriginIsNone) {
  for (const double far_m : {2e6, -2e6, 1e12}) {
    const OccupancyGrid far = free_grid({far_m - 6.0, -4.0}, {far_m + 8.0, 4.0});
    const PlanQuery query = from_standing({far_m - 3.0, 0.0}, 0.0, {far_m + 3.0, 0.0});
    PlanResult result;
    ASSERT_NO_THROW(result = plan(query, far)) << far_m;
    EXPECT_EQ(result.reason, PlanReason::kNoMap) << far_m << ": " << result.message;
    EXPECT_TRUE(result.motion.empty());
    EXPECT_FALSE(result.message.empty());
  }
}

TEST_F(GlobalPlannerTest, FromAStateThatNoRobotHasThereIsAReasonAndNoPlan) {
  for (const double speed : {30.0, 1e3, 1e5, 1e6}) {
    PlanQuery query;
    query.committed = straight_drive(kStart_s, {-2.0 * speed, 0.0}, 0.0, 4.0 * speed, speed, speed);
    query.start_time_s = 0.5 * (kStart_s + query.committed.end_time());
    query.goal = {8.0, 0.0};
    PlanResult result;
    ASSERT_NO_THROW(result = plan(query, open_)) << speed;
    EXPECT_EQ(result.reason, PlanReason::kNotCertified) << speed << ": " << result.message;
    EXPECT_TRUE(result.motion.empty());
    EXPECT_EQ(result.message.find("no violation"), std::string::npos) << result.message;
  }
}

TEST_F(GlobalPlannerTest, MovingStartAtTheGoalStillStops) {
  PlanQuery query;
  query.committed = straight_drive(kStart_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  query.start_time_s = kStart_s + 4.0;
  query.goal = query.committed.at(query.start_time_s).pose.position;
  const PlanResult result = plan(query, open_);
  expect_certified(result, query, open_);
  expect_joined(result, query);
  EXPECT_LT((result.motion.end_pose().position - query.goal).norm(), 0.05);
}

TEST_F(GlobalPlannerTest, AMapOfOneCellIsNoWay) {
  const OccupancyGrid tiny = free_grid({0.0, 0.0}, {0.05, 0.05});
  EXPECT_EQ(plan(from_standing({0.02, 0.02}, 0.0, {8.0, 0.0}), tiny).reason, PlanReason::kNoPath);
}

}  // namespace
}  // namespace mocha
