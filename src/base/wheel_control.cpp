#include "base/wheel_control.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace mocha {
namespace {

constexpr double kMostPwm = 255.0;
constexpr double kCatchUp = 4.0;        // [1/s]
constexpr double kMostBehind_m = 0.03;  // farther, it is held, or skids
constexpr double kSteady = 0.03;        // [m/s] below, wheels go in steps
constexpr double kStep_m = 0.004;
constexpr double kStill_s = 0.15;        // without a pulse, a wheel that rolls is seen by then
constexpr double kMeasuring_s = 0.0375;  // a reading and a half

}  // namespace

WheelControl::Options WheelControl::Options::from(const ParameterTable& values,
                                                  const RobotModel& model) {
  const Options options{values.number("pwm_per_speed"), values.number("friction_pwm"),
                        values.number("breakaway_pwm"), model.actuator_lag_s + kMeasuring_s};
  if (options.breakaway_pwm >= options.friction_pwm) return options;
  throw ParameterError("breakaway_pwm = " + std::to_string(options.breakaway_pwm) +
                       ", expected no less than friction_pwm");
}

void WheelControl::measure(const WheelTravel::Step& step) {
  still_s_ = step.rolls ? 0.0 : still_s_ + step.dt_s;
  behind_m_ -= step.rolled_m;
}

double WheelControl::pwm(double dt_s, double wanted) {
  expected_ += (1.0 - std::exp(-dt_s / options_.lag_s)) * (wanted_ - expected_);
  behind_m_ = std::clamp(behind_m_ + expected_ * dt_s, -kMostBehind_m, kMostBehind_m);
  wanted_ = wanted;
  if (wanted == 0.0) {
    expected_ = 0.0;
    behind_m_ = 0.0;
    return 0.0;
  }
  const double direction = std::copysign(1.0, wanted);
  const double behind_m = direction * behind_m_;
  steps_ = std::abs(wanted) > kSteady || behind_m > (steps_ ? 0.0 : kStep_m);
  if (!steps_) return 0.0;
  const double friction = still_s_ > kStill_s ? options_.breakaway_pwm : options_.friction_pwm;
  const double size = friction + options_.pwm_per_speed * (std::abs(wanted) + kCatchUp * behind_m);
  return direction * std::clamp(size, 0.0, kMostPwm);
}

}  // namespace mocha
