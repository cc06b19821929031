#include "control/odometry_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mocha {
namespace {

constexpr double kArm_m = 0.5;
constexpr double kLongestHold_s = 0.1;  // a command holds no longer

}  // namespace

void OdometryCheck::add(double time_s, const Pose& odometry, const UnicycleState& command) {
  if (time_s_ == time_s) return;
  const bool is_back = time_s_ && time_s < *time_s_;  // the clock was set back
  const bool has_changed = !time_s_ || is_back || odometry.position != odometry_.position ||
                           odometry.yaw_rad != odometry_.yaw_rad;
  if (has_changed) {
    travel_m_ = 0.0;
    frozen_until_s_.reset();
  } else {
    const double dt_s = std::min(time_s - *time_s_, kLongestHold_s);
    travel_m_ += dt_s * (std::abs(command.speed) + kArm_m * std::abs(command.yaw_rate));
  }
  time_s_ = time_s;
  odometry_ = odometry;
  if (travel_m_ <= max_travel_m_) return;
  frozen_until_s_ = time_s + hold_s_;
  travel_m_ = 0.0;
}

std::string OdometryCheck::words() const {
  char text[160];
  std::snprintf(text, sizeof(text),
                "the odometry stands to the last digit, though more than %.2f m were commanded: it "
                "is frozen, or the wheels are blocked",
                max_travel_m_);
  return text;
}

}  // namespace mocha
