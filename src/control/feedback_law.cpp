#include "control/feedback_law.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kNoDirection = 1e-4;  // [m/s] below, there is no direction to drive in

Vector2 in_frame(const Pose& frame, const Vector2& point) {
  return Eigen::Rotation2Dd(-frame.yaw_rad) * (point - frame.position);
}

double sinc(double angle) {
  return std::abs(angle) < 1e-4 ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
}

}  // namespace

double TrackingError::position_m() const { return std::hypot(along_m, across_m); }

FeedbackGains FeedbackGains::from(const ParameterTable& values) {
  FeedbackGains gains;
  gains.along = values.number("along_gain");
  gains.across = values.number("across_gain");
  gains.max_bandwidth = values.number("max_bandwidth");
  gains.damping = values.number("damping");
  gains.heading = values.number("heading_gain");
  gains.settle_start_rad = values.number("settle_start");
  gains.settle_stop_rad = values.number("settle_stop");
  return gains;
}

TrackingError tracking_error(const Pose& pose, const Pose& reference) {
  const Vector2 offset = in_frame(reference, pose.position);
  return {offset.x(), offset.y(), wrap_angle(pose.yaw_rad - reference.yaw_rad)};
}

UnicycleState feedback(const Pose& pose, const Pose& reference, const UnicycleState& feedforward,
                       const FeedbackGains& gains) {
  const double heading = wrap_angle(reference.yaw_rad - pose.yaw_rad);
  const double v = feedforward.speed;
  UnicycleState command = {0.0, feedforward.yaw_rate + gains.heading * heading};
  if (std::abs(v) < kNoDirection) return command;

  const Vector2 offset = in_frame(pose, reference.position);
  const double bandwidth = std::min(gains.across * std::abs(v), gains.max_bandwidth);
  const double heading_gain = std::max(gains.heading, 2.0 * gains.damping * bandwidth);
  const double direction = std::copysign(1.0, v);
  const double speed = v * std::cos(heading) + gains.along * offset.x();
  command.speed = direction * std::max(0.0, direction * speed);
  command.yaw_rate = feedforward.yaw_rate + bandwidth * bandwidth / v * sinc(heading) * offset.y() +
                     heading_gain * heading;
  return command;
}

}  // namespace mocha
