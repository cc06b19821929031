#include "ros_bridge/messages/space_conversions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/status_conversions.h"
#include "trajectory/arc_length.h"
#include "trajectory/minco.h"

namespace mocha {
namespace {

constexpr double kSpacePathStep_s = 0.1;

mocha_ugv::PlannerStatus status_of(PlanReason reason, const BasicViolation<3>& violation,
                                   const std::string& text, const std::string& frame,
                                   ros::Time stamp) {
  Violation flat;
  flat.term = violation.term;
  flat.time_s = stamp.toSec() + violation.time_s;
  flat.place = violation.place.head<2>();
  flat.value = violation.value;
  flat.limit = violation.limit;
  flat.peer = violation.peer;
  mocha_ugv::PlannerStatus status = to_message(reason, flat, text, frame, stamp);
  status.place.z = violation.place.z();
  return status;
}

mocha_ugv::Fallback fallback_message(const BasicFallback<3>& fallback) {
  mocha_ugv::Fallback message;
  message.kind = static_cast<uint8_t>(fallback.kind);
  message.message = describe(fallback);
  message.place = point_message(fallback.place);
  message.in_last_plan = true;
  return message;
}

mocha_ugv::SpaceCandidate candidate_message(const SpaceCandidate& candidate, double radius_m,
                                            const std::string& frame, ros::Time stamp) {
  mocha_ugv::SpaceCandidate message;
  message.signature.assign(candidate.signature.begin(), candidate.signature.end());
  message.certified = candidate.reason == PlanReason::kSolved;
  message.cost = candidate.cost;
  message.terms = cost_terms_message(candidate.terms);
  message.status =
      status_of(candidate.reason, candidate.violation, outcome(candidate), frame, stamp);
  mocha_ugv::PlanningEffort& effort = message.status.effort;
  effort.evaluations = candidate.evaluations;
  effort.parameterisation = static_cast<uint8_t>(candidate.parameterisation);
  if (candidate.fallback) effort.fallbacks.push_back(fallback_message(*candidate.fallback));
  for (const Eigen::Vector3d& point : candidate.path) message.path.push_back(point_message(point));
  message.trajectory = curve_message(candidate.curve, radius_m, frame, stamp);
  if (candidate.curve.pieces() == 0) return message;
  message.duration = candidate.curve.duration();
  message.length = arc_length(candidate.curve);
  return message;
}

}  // namespace

Eigen::Vector3d from_message(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}

geometry_msgs::Point point_message(const Eigen::Vector3d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

Tube<3> from_message(const mocha_ugv::MovingBall& ball) {
  const Eigen::Vector3d place = from_message(ball.position);
  const Eigen::Vector3d velocity(ball.velocity.x, ball.velocity.y, ball.velocity.z);
  constexpr double kMost = 1e6;  // [m], [m/s]
  const bool is_sound = place.cwiseAbs().maxCoeff() < kMost &&
                        velocity.cwiseAbs().maxCoeff() < kMost && ball.radius >= 0.0 &&
                        ball.radius < kMost;
  if (!place.allFinite() || !velocity.allFinite() || !is_sound)
    throw std::invalid_argument(
        "moving: position and velocity of a ball have to be finite and within 1e6 m and m/s, its "
        "radius from 0 to 1e6 m");
  return steady_tube<3>(place, velocity, ball.radius);
}

mocha_ugv::SpaceTrajectory curve_message(const PiecewisePolynomial<3, 3>& curve, double radius_m,
                                         const std::string& frame, ros::Time stamp) {
  mocha_ugv::SpaceTrajectory message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.s = 3;
  message.radius = radius_m;
  if (curve.pieces() == 0) return message;
  for (int i = 0; i < curve.pieces(); ++i) {
    message.points.push_back(point_message(curve.position(curve.piece_start(i))));
    message.durations.push_back(curve.piece_duration(i));
  }
  message.points.push_back(point_message(curve.position(curve.duration())));
  return message;
}

PiecewisePolynomial<3, 3> from_message(const mocha_ugv::SpaceTrajectory& message) {
  const auto pieces = static_cast<int>(message.durations.size());
  if (pieces < 1 || message.points.size() != message.durations.size() + 1)
    throw std::invalid_argument("has " + std::to_string(message.points.size()) + " points and " +
                                std::to_string(message.durations.size()) +
                                " durations: expected at least one duration, and one point more");
  if (message.s != 3)
    throw std::invalid_argument("s = " + std::to_string(message.s) + ": expected 3");
  Minco<3, 3>::State start = Minco<3, 3>::State::Zero();
  Minco<3, 3>::State end = Minco<3, 3>::State::Zero();
  Eigen::Matrix3Xd points(3, pieces + 1);
  Eigen::VectorXd durations_s(pieces);
  for (int i = 0; i <= pieces; ++i) points.col(i) = from_message(message.points[i]);
  for (int i = 0; i < pieces; ++i) durations_s[i] = message.durations[i];
  if (!points.allFinite() || !durations_s.allFinite() || !(durations_s.minCoeff() > 0.0))
    throw std::invalid_argument(
        "has points that are not finite, or durations that are not above 0");
  start.col(0) = points.col(0);
  end.col(0) = points.col(pieces);
  Minco<3, 3> minco;
  minco.resize(pieces);
  minco.solve(start, end, points.middleCols(1, pieces - 1), durations_s);
  for (int i = 0; i < pieces; ++i) {
    if (!minco.piece(i).allFinite())
      throw std::invalid_argument("has durations that no curve can keep to");
  }
  return minco.curve();
}

nav_msgs::Path to_path(const PiecewisePolynomial<3, 3>& curve, const std::string& frame,
                       ros::Time stamp, double dt) {
  nav_msgs::Path path;
  path.header.frame_id = frame;
  path.header.stamp = stamp;
  if (curve.pieces() == 0) return path;
  const int steps = static_cast<int>(std::ceil(curve.duration() / dt));
  double yaw_rad = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double t = std::min(i * dt, curve.duration());
    const Eigen::Vector3d velocity = curve.derivative(t, 1);
    if (velocity.head<2>().norm() > 1e-3) yaw_rad = std::atan2(velocity.y(), velocity.x());
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = frame;
    pose.header.stamp = stamp + ros::Duration(t);
    pose.pose.position = point_message(curve.position(t));
    pose.pose.orientation.z = std::sin(0.5 * yaw_rad);
    pose.pose.orientation.w = std::cos(0.5 * yaw_rad);
    path.poses.push_back(pose);
  }
  return path;
}

mocha_ugv::PlanInSpace::Response to_message(const SpacePlan& plan, double radius_m,
                                            const std::string& frame, ros::Time stamp) {
  mocha_ugv::PlanInSpace::Response message;
  message.success = plan.reason == PlanReason::kSolved;
  message.message = plan.message;
  const bool has_violation = !message.success && !plan.candidates.empty();
  message.status = status_of(
      plan.reason, has_violation ? plan.candidates.front().violation : BasicViolation<3>(),
      plan.message, frame, stamp);
  if (const SpaceCandidate* best = plan.selected()) {
    message.trajectory = curve_message(best->curve, radius_m, frame, stamp);
    message.path = to_path(best->curve, frame, stamp, kSpacePathStep_s);
  }
  for (const SpaceCandidate& candidate : plan.candidates)
    message.candidates.push_back(candidate_message(candidate, radius_m, frame, stamp));
  return message;
}

}  // namespace mocha
