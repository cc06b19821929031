#include "simulation/wheel_drive.h"

#include <algorithm>
#include <cmath>

#include "simulation/time_slack.h"

namespace mocha {
namespace {

constexpr double kPulse_m = M_PI * 0.08 / 660.0;
constexpr double kLoop_s = 0.001;
constexpr double kControlPeriod_s = 0.1;
constexpr double kProportional = 20.0;  // [1 / (m/s)]
constexpr double kIntegral = 2000.0;    // [1 / m]
constexpr double kDeadBand = 23.0;
constexpr double kTopSpeed = 1.3;    // [m/s]
constexpr double kHeldSpeed = 0.01;  // [m/s] below, friction holds the wheel

}  // namespace

void WheelDrive::roll(double rolled_m, double speed) {
  rolled_m_ += rolled_m;
  speed_ = speed;
}

double WheelDrive::measured_speed() const {
  const double before_m = rolled_m_ - kLoop_s * speed_;
  return kPulse_m / kLoop_s * (std::floor(rolled_m_ / kPulse_m) - std::floor(before_m / kPulse_m));
}

void WheelDrive::control(double wanted) {
  const double error = wanted - measured_speed();
  sum_ = std::clamp(sum_ + kIntegral * kControlPeriod_s * error, -kMostPwm, kMostPwm);
  output_ = std::clamp(sum_ + kProportional * error, -kMostPwm, kMostPwm);
}

double WheelDrive::follow_speed(double now_s, double wanted) {
  const double since_s = now_s - controlled_s_;
  if (since_s < 0.0 || since_s >= kControlPeriod_s - kTimeSlack_s) {
    controlled_s_ = now_s;
    control(wanted);
  }
  const double share_with_pulse = std::min(1.0, std::abs(speed_) * kLoop_s / kPulse_m);
  const double pwm = std::abs(output_) < kDeadBand ? 0.0 : output_;
  return follow_pwm(wanted == 0.0 ? share_with_pulse * pwm : pwm);
}

double WheelDrive::follow_pwm(double pwm) const {
  const bool stands = std::abs(speed_) < kHeldSpeed;
  const double holding = stands ? options_.breakaway_pwm : options_.friction_pwm;
  if (std::abs(pwm) <= holding) return 0.0;
  const double friction = std::copysign(options_.friction_pwm, stands ? pwm : speed_);
  return kTopSpeed / (kMostPwm - options_.friction_pwm) *
         (std::clamp(pwm, -kMostPwm, kMostPwm) - friction);
}

}  // namespace mocha
