#include "planning/candidates/drive_optimizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planning/candidates/peer_discs.h"
#include "planning/candidates/start_maneuver.h"
#include "planning/worlds.h"
#include "safety/circle_field.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

const DurationCost kDurationCost = DurationCost::total(1.0);
const std::function<bool()> kGoOn = [] { return false; };

class DriveOptimizerTest : public ::testing::Test {
 protected:
  DriveQuery from_rest(const std::vector<Vector2>& path) const {
    DriveQuery query{path, PlanarMinco::State::Zero(), 0.0, {}, {}, {}, kDurationCost, {}};
    query.start.col(0) = path.front();
    query.start.col(2) = rest_acceleration(robot_.limits) * (path[1] - path[0]).normalized();
    return query;
  }

  Motion drive(const DriveQuery& query, const ObstacleField<2>& field,
               const Effort& effort = {}) const {
    const auto found = optimizer_.optimize_drive(query, field, effort, kGoOn);
    return Motion(query.start_time_s, {DrivePhase{1, found.curve}});
  }

  const RobotModel robot_ = rover();
  const DriveOptimizer optimizer_{robot_, default_options(),
                                  MarginBudget::of(robot_).static_margin()};
  const CircleField open_{{}};
};

TEST_F(DriveOptimizerTest, StraightIsFastAndWithinTheLimits) {
  const Motion motion = drive(from_rest({{0.0, 0.0}, {10.0, 0.0}}), open_);
  const Violation violation = check_limits(motion, robot_.limits, 0.0);
  EXPECT_FALSE(violation) << describe(violation);
  const double kinematic_s =
      10.0 / robot_.limits.max_speed + robot_.limits.max_speed / robot_.limits.max_acceleration;
  EXPECT_LT(motion.end_time(), 1.25 * kinematic_s);
  EXPECT_LT((motion.end_pose().position - Vector2(10.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(motion.end_pose().yaw_rad, 0.0, 1e-6);
}

TEST_F(DriveOptimizerTest, KeepsClearOfWhatStandsBesideTheWay) {
  const CircleField field({{{5.0, 0.5}, 0.3}});
  const Motion motion = drive(from_rest({{0.0, 0.0}, {10.0, 0.0}}), field);
  const Violation violation = check_clearance(motion, robot_.footprint, field,
                                              MarginBudget::of(robot_).static_margin(), 0.0);
  EXPECT_FALSE(violation) << describe(violation);
}

TEST_F(DriveOptimizerTest, SlowsDownBetweenWallsButBesideOneKeepsOff) {
  const double off_m = robot_.footprint.inscribed_radius_m() + 0.05;
  const auto term = [&](const std::vector<double>& sides, const char* name) {
    std::vector<CircleField::Circle> rows;
    for (const double side : sides) {
      for (double x = 3.0; x <= 7.0; x += 0.1) rows.push_back({{x, side * (off_m + 0.1)}, 0.1});
    }
    const auto found = optimizer_.optimize_drive(from_rest({{0.0, 0.0}, {10.0, 0.0}}),
                                                 CircleField(rows), {}, kGoOn);
    return std::any_of(found.terms.begin(), found.terms.end(),
                       [&](const auto& each) { return each.first == name; });
  };
  EXPECT_TRUE(term({-1.0, 1.0}, "clearance"));
  EXPECT_FALSE(term({-1.0}, "clearance"));
  EXPECT_FALSE(term({}, "clearance"));
  EXPECT_TRUE(term({}, "obstacle"));
}

TEST_F(DriveOptimizerTest, ALongDriveInTheOpenIsNearlyTimeOptimal) {
  const Motion motion = drive(from_rest({{0.0, 0.0}, {100.0, 0.0}}), open_);
  EXPECT_FALSE(check_limits(motion, robot_.limits, 0.0));
  const double kinematic_s =
      100.0 / robot_.limits.max_speed + robot_.limits.max_speed / robot_.limits.max_acceleration;
  EXPECT_LT(motion.end_time(), 1.05 * kinematic_s);
}

TEST(DriveOptimizerWheels, SlowDownInBendsWhereTheWheelsAskForIt) {
  RobotModel robot = rover();
  robot.limits.max_wheel_speed = robot.limits.max_speed;  // none to spare for turning
  robot.limits.track_m = 0.5;
  const DriveOptimizer optimizer(robot, default_options(), MarginBudget::of(robot).static_margin());
  DriveQuery query{{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}},
                   PlanarMinco::State::Zero(),
                   0.0,
                   {},
                   {},
                   {},
                   kDurationCost,
                   {}};
  query.start.col(2) = Vector2(rest_acceleration(robot.limits), 0.0);
  const CircleField open({});
  const auto found = optimizer.optimize_drive(query, open, {}, kGoOn);
  const Motion motion(0.0, {DrivePhase{1, found.curve}});
  double fastest = 0.0;
  for (double t = 0.01; t < motion.end_time(); t += 0.01) {
    const MotionState state = motion.at(t);
    fastest = std::max(
        fastest, state.velocity.norm() + 0.5 * robot.limits.track_m * std::abs(state.yaw_rate));
  }
  EXPECT_LT(fastest, 1.02 * robot.limits.max_wheel_speed);
  EXPECT_GT(fastest, 0.9 * robot.limits.max_wheel_speed);
  const auto violation = check_limits(motion, robot.limits, 0.0);
  EXPECT_FALSE(violation) << describe(violation);
  robot.limits.track_m = 0.01;
  const DriveOptimizer free(robot, default_options(), MarginBudget::of(robot).static_margin());
  EXPECT_LT(free.optimize_drive(query, open, {}, kGoOn).curve.duration(), found.curve.duration());
}

/// Within other limits it is as a robot that has these as its own would drive.
TEST_F(DriveOptimizerTest, DrivesWithinTheLimitsThatAreGiven) {
  DriveQuery query = from_rest({{0.0, 0.0}, {6.0, 1.0}});
  query.limits = robot_.emergency_limits();
  query.start.col(2) = rest_acceleration(*query.limits) * Vector2(6.0, 1.0).normalized();
  RobotModel other = robot_;
  other.limits = *query.limits;
  const DriveOptimizer hard(other, default_options(), MarginBudget::of(robot_).static_margin());
  DriveQuery own = query;
  own.limits.reset();
  const auto given = optimizer_.optimize_drive(query, open_, {}, kGoOn);
  const auto owned = hard.optimize_drive(own, open_, {}, kGoOn);
  EXPECT_EQ(given.cost, owned.cost);
  EXPECT_EQ(given.curve.duration(), owned.curve.duration());
  const Violation violation =
      check_limits(Motion(0.0, {DrivePhase{1, given.curve}}), *query.limits, 0.0);
  EXPECT_FALSE(violation) << describe(violation);
  EXPECT_LT(given.curve.duration(),
            optimizer_.optimize_drive(own, open_, {}, kGoOn).curve.duration() - 0.3);
}

TEST_F(DriveOptimizerTest, GoesOnFromTheStateGiven) {
  DriveQuery query = from_rest({{0.0, 0.0}, {6.0, 1.0}});
  query.start.col(1) = Vector2(0.6, -0.1);
  query.start.col(2) = Vector2(-0.1, 0.2);
  const auto found = optimizer_.optimize_drive(query, open_, {}, kGoOn);
  EXPECT_LT((found.curve.state(0.0) - query.start).norm(), 1e-9);
  EXPECT_LT(found.curve.derivative(found.curve.duration(), 1).norm(), 1e-9);
}

TEST_F(DriveOptimizerTest, BackwardItsTailGoesAhead) {
  const CircleField field({{{4.0, 0.55}, 0.3}});
  DriveQuery query = from_rest({{0.0, 0.0}, {4.0, -0.3}, {6.0, 1.5}});
  const auto found = [&](double tail_m, double nose_m, int direction) {
    RobotModel robot = robot_;
    robot.footprint =
        Footprint::polygon({{-tail_m, -0.2}, {nose_m, -0.2}, {nose_m, 0.2}, {-tail_m, 0.2}});
    query.direction = direction;
    return DriveOptimizer(robot, default_options(), MarginBudget::of(robot).static_margin())
        .optimize_drive(query, field, {}, kGoOn)
        .curve.position(3.0);
  };
  const Vector2 tail_first = found(1.5, 0.25, -1);
  EXPECT_LT((tail_first - found(0.25, 1.5, 1)).norm(),
            0.3 * (tail_first - found(1.5, 0.25, 1)).norm());
}

TEST_F(DriveOptimizerTest, WaitsOrSwervesForAPeer) {
  DriveQuery query = from_rest({{0.0, 0.0}, {8.0, 0.0}});
  query.start_time_s = 50.0;
  // Crosses the way of the robot just when that would be there.
  const double there_s =
      drive(query, open_).end_time() - 0.5 * (drive(query, open_).end_time() - 50.0);
  const auto peer = std::make_shared<PredictedDisc>("peer", there_s, Vector2(4.0, 0.0),
                                                    Vector2(0.0, 0.4), 0.3, 0.0);
  const auto nearest = [&](const Motion& motion) {
    double least = 1e9;
    for (double t = 50.0; t < motion.end_time(); t += 0.02) {
      least = std::min(least, (motion.at(t).pose.position - peer->at(t).centre).norm());
    }
    return least;
  };
  EXPECT_LT(nearest(drive(query, open_)), 0.3);
  query.moving = {{peer, distance_to_peers_m(robot_), kForever_s}};
  EXPECT_GT(nearest(drive(query, open_)), 0.6 + robot_.peer_clearance_m);
}

TEST_F(DriveOptimizerTest, NamesTheTermsOfTheCost) {
  DriveQuery query = from_rest({{0.0, 0.0}, {4.0, 0.0}});
  const auto peer =
      std::make_shared<PredictedDisc>("peer", 0.0, Vector2(2.0, 9.0), Vector2(0.0, 0.4), 0.3, 0.0);
  query.moving = {{peer, distance_to_peers_m(robot_), kForever_s}};
  std::string names;
  for (const auto& term : optimizer_.optimize_drive(query, open_, {}, kGoOn).terms)
    names += term.first + " ";
  EXPECT_EQ(names, "control_effort duration obstacle dynamics turning moving ");
}

TEST_F(DriveOptimizerTest, HasNothingWhenItMayNotWork) {
  const auto found = optimizer_.optimize_drive(from_rest({{0.0, 0.0}, {4.0, 0.0}}), open_, {},
                                               [] { return true; });
  EXPECT_EQ(found.stop, StopReason::kStopped);
  EXPECT_EQ(found.curve.pieces(), 0);
}

TEST_F(DriveOptimizerTest, SurvivesPathsThatAreHardlyOnes) {
  for (const double length_m : {1e-9, 1e-3, 0.03, 0.3}) {
    const auto found =
        optimizer_.optimize_drive(from_rest({{1.0, 1.0}, {1.0 + length_m, 1.0}}), open_, {}, kGoOn);
    ASSERT_GT(found.curve.pieces(), 0) << length_m;
    EXPECT_TRUE(std::isfinite(found.cost));
  }
}

TEST_F(DriveOptimizerTest, SharpCornersComeOutWithinTheYawRate) {
  const Motion motion = drive(from_rest({{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}}), open_);
  const Violation violation = check_limits(motion, robot_.limits, 0.0);
  EXPECT_FALSE(violation) << describe(violation);
}

TEST_F(DriveOptimizerTest, SaysWhyAndWhereWaypointsAreItsVariables) {
  const auto fallen_back = [&](const DriveQuery& query, const Effort& effort = {}) {
    const auto found = optimizer_.optimize_drive(query, open_, effort, kGoOn);
    const bool waypoints = found.parameterisation == Parameterisation::kWaypoints;
    EXPECT_EQ(waypoints, !found.fallbacks.empty());
    EXPECT_LE(found.fallbacks.size(), 1u);
    return found.fallbacks;
  };
  const DriveQuery straight = from_rest({{0.0, 0.0}, {6.0, 0.0}});
  EXPECT_TRUE(fallen_back(straight).empty());
  const auto expect = [&](const std::vector<double>& knots, FallbackKind kind, double place) {
    DriveQuery query = straight;
    const auto points = static_cast<Eigen::Index>(knots.size());
    query.found_before.emplace();
    query.found_before->path = Eigen::Matrix2Xd::Zero(2, points);
    query.found_before->path.row(0) = Eigen::Map<const Eigen::RowVectorXd>(knots.data(), points);
    query.found_before->durations_s = Eigen::VectorXd::Constant(points - 1, 3.0);
    const auto fallbacks = fallen_back(query);
    ASSERT_EQ(fallbacks.size(), 1u);
    EXPECT_EQ(fallbacks[0].kind, kind);
    EXPECT_EQ(fallbacks[0].place, Vector2(place, 0.0));
  };
  expect({0.0, 2.0, 2.0, 6.0}, FallbackKind::kCoincidentPoints, 2.0);
  expect({0.0, 2.0, 4.0, 2.0, 0.0}, FallbackKind::kSharpBend, 4.0);
  Effort effort;
  effort.fallback = Fallback{FallbackKind::kCamouflageGivenUp, {1.0, 2.0}};
  const auto given_up = fallen_back(straight, effort);
  ASSERT_EQ(given_up.size(), 1u);
  EXPECT_EQ(given_up[0].kind, FallbackKind::kCamouflageGivenUp);
  EXPECT_EQ(given_up[0].place, Vector2(1.0, 2.0));
}

TEST(Effort, IsRaisedWhereItIsMissing) {
  Violation clearance;
  clearance.term = ViolatedTerm::kClearance;
  Violation yaw_rate;
  yaw_rate.term = ViolatedTerm::kYawRate;
  const Effort first;
  EXPECT_GT(raised(first, clearance, 20.0).obstacle_weight, first.obstacle_weight);
  EXPECT_EQ(raised(first, clearance, 20.0).limit_weight, first.limit_weight);
  EXPECT_GT(raised(first, yaw_rate, 20.0).limit_weight, first.limit_weight);
  EXPECT_EQ(raised(first, yaw_rate, 20.0).obstacle_weight, first.obstacle_weight);
  Effort effort = first;
  for (int i = 0; i < 4; ++i) {
    yaw_rate.place.x() = i;
    effort = raised(effort, yaw_rate, 20.0);
    EXPECT_EQ(effort.fallback.has_value(), i > 0);
  }
  EXPECT_EQ(effort.fallback->kind, FallbackKind::kCamouflageGivenUp);  // the knots move freely
  EXPECT_EQ(effort.fallback->place.x(), 1.0);
  EXPECT_LT(effort.speed, 1.0);
  EXPECT_GT(effort.spacing, 0.3);
}

}  // namespace
}  // namespace mocha
