#include "planning/global/global_planner.h"

#include <cmath>
#include <memory>
#include <variant>

#include "planning/global/global_planner_fixture.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

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

/// As a crowd that will have moved on, or that was one of people and not a wall.
TEST_F(GlobalPlannerTest, AnOccupiedGoalFarAwayIsApproached) {
  OccupancyGrid grid = open_;
  fill_disc(grid, {8.0, 0.0}, 1.0, OccupancyGrid::kOccupied);
  const PlanQuery query = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
  const PlanResult far = plan(query, grid);
  expect_certified(far, query, grid);
  EXPECT_LT((far.motion.end_pose().position - query.goal).norm(), 0.25 * 8.0);
  EXPECT_NE(far.message.find("near the goal, which is occupied"), std::string::npos) << far.message;
  const PlanResult near = plan(from_standing({6.4, 0.0}, 0.0, {8.0, 0.0}), grid);
  EXPECT_EQ(near.reason, PlanReason::kGoalOccupied) << near.message;
}

TEST_F(GlobalPlannerTest, GoalDeepInAWallIsOccupied) {
  OccupancyGrid grid = open_;
  fill_disc(grid, {8.0, 0.0}, 2.5, OccupancyGrid::kOccupied);
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

}  // namespace
}  // namespace mocha
