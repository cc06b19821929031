#include "trajectory/braking.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

constexpr double kLeastShare = 0.25;  // of the deceleration, beside what the bend takes

void require_of_braking(bool holds, const char* name, double value, const char* unit,
                        const char* range) {
  if (holds) return;
  throw std::invalid_argument(std::string("braking: ") + name + " = " + std::to_string(value) +
                              " " + unit + ", allowed is " + range);
}

}  // namespace

Braking::Braking(double deceleration, double max_acceleration, double yaw_deceleration)
    : deceleration_(deceleration),
      max_acceleration_(max_acceleration),
      yaw_deceleration_(yaw_deceleration) {
  require_of_braking(deceleration > 0.0 && std::isfinite(deceleration), "deceleration",
                     deceleration, "m/s^2", "a finite value above 0");
  require_of_braking(max_acceleration > 0.0, "max_acceleration", max_acceleration, "m/s^2",
                     "a value above 0");
  require_of_braking(yaw_deceleration > 0.0 && std::isfinite(yaw_deceleration), "yaw_deceleration",
                     yaw_deceleration, "rad/s^2", "a finite value above 0");
}

double Braking::beside(double lateral) const {
  const double left = max_acceleration_ * max_acceleration_ - lateral * lateral;
  return std::clamp(std::sqrt(std::max(0.0, left)), kLeastShare * deceleration_, deceleration_);
}

}  // namespace mocha
