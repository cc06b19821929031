#include "simulation/vehicle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "simulation/time_slack.h"

namespace mocha {
namespace {

constexpr double kSettledSpeed = 1e-6;  // [m/s] from here on a wheel turns exactly as wanted

}  // namespace

Vehicle::Vehicle(const RobotModel& model, const Pose& start)
    : max_wheel_speed_(model.limits.max_wheel_speed),
      max_wheel_acceleration_(model.max_wheel_acceleration),
      track_m_(model.limits.track_m),
      can_reverse_(model.limits.can_reverse),
      lag_s_(model.actuator_lag_s),
      cmd_timeout_s_(model.cmd_timeout_s),
      pose_(start),
      command_time_s_(-std::numeric_limits<double>::infinity()) {}

void Vehicle::command(double now_s, const Twist& twist) {
  if (!std::isfinite(twist.speed) || !std::isfinite(twist.yaw_rate)) {
    throw std::invalid_argument("Vehicle: the commanded speed or yaw rate is not finite");
  }
  command_ = twist;
  command_time_s_ = now_s;
}

Vehicle::Wheels Vehicle::wanted(double now_s) const {
  if (now_s - command_time_s_ > cmd_timeout_s_ + kTimeSlack_s) return {};
  const double speed = can_reverse_ ? command_.speed : std::max(0.0, command_.speed);
  const double difference = 0.5 * track_m_ * command_.yaw_rate;
  // The faster wheel runs at the sum of both magnitudes; scaling both keeps the curvature.
  const double fastest = std::abs(speed) + std::abs(difference);
  const double scale = fastest > max_wheel_speed_ ? max_wheel_speed_ / fastest : 1.0;
  if (scale == 0.0) return {};  // absurd commands, whose sum is infinite
  return {scale * (speed - difference), scale * (speed + difference)};
}

double Vehicle::followed(double speed, double wanted, double dt_s) const {
  if (std::abs(wanted - speed) < kSettledSpeed) return wanted;
  const double response = lag_s_ > 0.0 ? 1.0 - std::exp(-dt_s / lag_s_) : 1.0;
  const double most = max_wheel_acceleration_ * dt_s;
  return speed + std::clamp(response * (wanted - speed), -most, most);
}

Arc Vehicle::step(double now_s, double dt_s) {
  const Wheels target = wanted(now_s);
  const Twist before = twist();
  wheels_ = {followed(wheels_.left, target.left, dt_s),
             followed(wheels_.right, target.right, dt_s)};
  const Twist after = twist();
  acceleration_ = (after.speed - before.speed) / dt_s;
  const Arc arc{0.5 * dt_s * (before.speed + after.speed),
                0.5 * dt_s * (before.yaw_rate + after.yaw_rate)};
  pose_ = advanced(pose_, arc);
  return arc;
}

Twist Vehicle::twist() const {
  return {0.5 * (wheels_.left + wheels_.right), (wheels_.right - wheels_.left) / track_m_};
}

}  // namespace mocha
