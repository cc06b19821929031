#include "control/command_limiter.h"

#include <algorithm>
#include <cmath>

namespace mocha {

CommandLimiter::CommandLimiter(const RobotModel& robot)
    : max_wheel_speed_(robot.limits.max_wheel_speed),
      max_wheel_acceleration_(robot.max_wheel_acceleration),
      track_m_(robot.limits.track_m),
      can_reverse_(robot.limits.can_reverse),
      deceleration_(robot.limits.max_acceleration),
      yaw_deceleration_(robot.limits.max_yaw_acceleration) {}

UnicycleState CommandLimiter::limit(const UnicycleState& wanted, double dt) {
  const double max_yaw_rate = 2.0 * max_wheel_speed_ / track_m_;
  const double yaw_rate = std::clamp(wanted.yaw_rate, -max_yaw_rate, max_yaw_rate);
  const double max_speed = max_wheel_speed_ - 0.5 * track_m_ * std::abs(yaw_rate);
  const WheelSpeeds from = wheel_speeds(last_, track_m_);
  const double min_speed = can_reverse_ ? -max_speed : 0.0;
  const WheelSpeeds to =
      wheel_speeds({std::clamp(wanted.speed, min_speed, max_speed), yaw_rate}, track_m_);
  const double change = std::max(std::abs(to.left - from.left), std::abs(to.right - from.right));
  const double allowed = max_wheel_acceleration_ * dt;
  const double share = change > allowed ? allowed / change : 1.0;
  last_ = from_wheel_speeds(
      {from.left + share * (to.left - from.left), from.right + share * (to.right - from.right)},
      track_m_);
  return last_;
}

UnicycleState CommandLimiter::ramp_down(double dt) {
  const double time_to_rest =
      std::max(std::abs(last_.speed) / deceleration_, std::abs(last_.yaw_rate) / yaw_deceleration_);
  const double share = dt < time_to_rest ? 1.0 - dt / time_to_rest : 0.0;
  return limit({share * last_.speed, share * last_.yaw_rate}, dt);
}

UnicycleState CommandLimiter::ramp_down_straight(double dt) {
  const double step = deceleration_ * dt;
  return limit({last_.speed - std::clamp(last_.speed, -step, step), 0.0}, dt);
}

}  // namespace mocha
