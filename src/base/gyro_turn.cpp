#include "base/gyro_turn.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kSettling_s = 0.5;  // a body sways on after its wheels stand
constexpr double kEnough_s = 1.0;    // of standing, for a first bias
constexpr double kMemory_s = 10.0;   // the bias follows the sensor's temperature
constexpr double kMostBias = 0.1;    // [rad/s] more is a robot turned by hand

}  // namespace

std::optional<double> GyroTurn::add(double dt_s, double yaw_rate, bool wheels_stand) {
  const double mean = 0.5 * (before_ + yaw_rate);
  before_ = yaw_rate;
  stood_s_ = wheels_stand ? stood_s_ + dt_s : 0.0;
  if (stood_s_ > kSettling_s && std::abs(yaw_rate) < kMostBias) learn(dt_s, yaw_rate);
  const std::optional<double> turn_rate = unbiased(mean);
  if (!turn_rate) return std::nullopt;
  return stood_s_ > kSettling_s ? 0.0 : *turn_rate * dt_s;
}

void GyroTurn::learn(double dt_s, double yaw_rate) {
  learnt_s_ = std::min(learnt_s_ + dt_s, kMemory_s);
  if (learnt_s_ > 0.0) bias_ += dt_s / learnt_s_ * (yaw_rate - bias_);
}

std::optional<double> GyroTurn::unbiased(double yaw_rate) const {
  if (learnt_s_ < kEnough_s) return std::nullopt;
  return yaw_rate - bias_;
}

}  // namespace mocha
