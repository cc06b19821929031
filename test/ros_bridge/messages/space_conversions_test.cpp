#include "ros_bridge/messages/space_conversions.h"

#include <gtest/gtest.h>

#include <limits>

#include "trajectory/minco.h"

namespace mocha {
namespace {

using Curve = PiecewisePolynomial<3, 3>;

Curve curve_through(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& durations_s) {
  Minco<3, 3>::State start = Minco<3, 3>::State::Zero();
  Minco<3, 3>::State end = Minco<3, 3>::State::Zero();
  start.col(0) = points.leftCols(1);
  end.col(0) = points.rightCols(1);
  Minco<3, 3> minco;
  minco.resize(static_cast<int>(durations_s.size()));
  minco.solve(start, end, points.middleCols(1, points.cols() - 2), durations_s);
  return minco.curve();
}

class SpaceConversionsTest : public testing::Test {
 protected:
  SpaceConversionsTest() {
    Eigen::Matrix3Xd points(3, 4);
    points << 0.0, 1.0, 2.5, 4.0, 0.0, 0.5, -0.5, 0.0, 1.0, 2.0, 2.0, 1.5;
    curve_ = curve_through(points, Eigen::Vector3d(1.0, 0.8, 1.3));
  }
  Curve curve_;
  const ros::Time stamp_{100.5};
};

TEST_F(SpaceConversionsTest, ACurveComesBackAsItWas) {
  const auto message = curve_message(curve_, 0.25, "map", stamp_);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.radius, 0.25);
  ASSERT_EQ(message.points.size(), 4u);
  const Curve again = from_message(message);
  EXPECT_NEAR(again.duration(), curve_.duration(), 1e-12);
  for (double t = 0.0; t < curve_.duration(); t += 0.05) {
    EXPECT_LT((again.position(t) - curve_.position(t)).norm(), 1e-9);
    EXPECT_LT((again.derivative(t, 2) - curve_.derivative(t, 2)).norm(), 1e-8);
  }
}

TEST_F(SpaceConversionsTest, WhatIsNoCurveIsRefused) {
  const auto good = curve_message(curve_, 0.25, "map", stamp_);
  const auto refused = [&](const std::function<void(mocha_ugv::SpaceTrajectory&)>& spoil) {
    auto message = good;
    spoil(message);
    EXPECT_THROW(from_message(message), std::invalid_argument);
  };
  refused([](auto& message) { message.points.pop_back(); });
  refused([](auto& message) { message.points.clear(), message.durations.clear(); });
  refused([](auto& message) { message.durations[1] = 0.0; });
  refused([](auto& message) { message.durations[1] = std::numeric_limits<double>::infinity(); });
  refused([](auto& message) { message.points[2].z = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& message) { message.s = 4; });
}

TEST_F(SpaceConversionsTest, ABallIsATubeOrRefused) {
  mocha_ugv::MovingBall ball;
  ball.position.x = 1.0;
  ball.velocity.z = -0.5;
  ball.radius = 0.3;
  const Tube<3> tube = from_message(ball);
  ASSERT_EQ(tube.size(), 1u);
  EXPECT_EQ(tube.front().centre_at(2.0), Eigen::Vector3d(1.0, 0.0, -1.0));
  EXPECT_EQ(tube.front().radius_at(2.0), 0.3);
  ball.radius = -0.1;
  EXPECT_THROW(from_message(ball), std::invalid_argument);
  ball.radius = 0.3;
  ball.velocity.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(from_message(ball), std::invalid_argument);
}

TEST_F(SpaceConversionsTest, APathHasTimesAndHeadings) {
  const nav_msgs::Path path = to_path(curve_, "map", stamp_, 0.1);
  ASSERT_EQ(path.poses.size(), 32u);
  EXPECT_EQ(path.poses.front().header.stamp, stamp_);
  EXPECT_NEAR((path.poses.back().header.stamp - stamp_).toSec(), curve_.duration(), 1e-6);
  EXPECT_NEAR(path.poses.back().pose.position.z, 1.5, 1e-9);
  for (const auto& pose : path.poses) {
    const auto& q = pose.pose.orientation;
    EXPECT_NEAR(q.z * q.z + q.w * q.w, 1.0, 1e-9);
  }
  const Eigen::Vector3d velocity = curve_.derivative(1.0, 1);
  const auto& q = path.poses[10].pose.orientation;
  EXPECT_NEAR(2.0 * std::atan2(q.z, q.w), std::atan2(velocity.y(), velocity.x()), 1e-9);
  EXPECT_TRUE(to_path(Curve(), "map", stamp_, 0.1).poses.empty());
}

TEST_F(SpaceConversionsTest, APlanSaysWhatIsViolatedWhereAndWhen) {
  SpacePlan plan;
  plan.reason = PlanReason::kNotCertified;
  plan.message = "too close";
  plan.candidates.resize(1);
  SpaceCandidate& candidate = plan.candidates.front();
  candidate.curve = curve_;
  candidate.violation.term = ViolatedTerm::kClearance;
  candidate.violation.place = {1.0, 2.0, 3.0};
  candidate.violation.time_s = 2.0;
  candidate.signature = {0, -1};
  candidate.terms = {{"duration", 3.0}, {"obstacle", 0.5}};
  candidate.evaluations = 42;
  candidate.parameterisation = Parameterisation::kWaypoints;
  candidate.fallback = {FallbackKind::kSharpBend, {4.0, 5.0, 6.0}};
  const auto message = to_message(plan, 0.25, "map", stamp_);
  EXPECT_FALSE(message.success);
  EXPECT_TRUE(message.trajectory.points.empty());
  EXPECT_EQ(message.status.violated, mocha_ugv::PlannerStatus::CLEARANCE);
  EXPECT_EQ(message.status.place.z, 3.0);
  EXPECT_NEAR(message.status.at.toSec(), 102.5, 1e-6);
  ASSERT_EQ(message.candidates.size(), 1u);
  EXPECT_FALSE(message.candidates[0].certified);
  EXPECT_EQ(message.candidates[0].signature, (std::vector<int>{0, -1}));
  ASSERT_EQ(message.candidates[0].terms.size(), 2u);
  EXPECT_EQ(message.candidates[0].terms[1].name, "obstacle");
  EXPECT_EQ(message.candidates[0].terms[1].value, 0.5);
  const auto& effort = message.candidates[0].status.effort;
  EXPECT_EQ(effort.evaluations, 42u);
  EXPECT_EQ(effort.parameterisation, mocha_ugv::PlanningEffort::WAYPOINTS);
  ASSERT_EQ(effort.fallbacks.size(), 1u);
  EXPECT_EQ(effort.fallbacks[0].kind, mocha_ugv::Fallback::SHARP_BEND);
  EXPECT_EQ(effort.fallbacks[0].place.z, 6.0);
  plan.reason = candidate.reason = PlanReason::kSolved;
  candidate.violation = {};
  const auto solved = to_message(plan, 0.25, "map", stamp_);
  EXPECT_TRUE(solved.success);
  EXPECT_EQ(solved.trajectory.points.size(), 4u);
  EXPECT_FALSE(solved.path.poses.empty());
}

}  // namespace
}  // namespace mocha
