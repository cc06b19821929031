#include "base/wheel_travel.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kUnit_m = 0.01;
constexpr double kLateness_s = 0.1;  // of a reading against its stamp, at most
constexpr double kSmoothing_s = 0.1;
constexpr double kRounding_m = 2.0 * kUnit_m;

struct Range {
  double low_m;
  double high_m;
};

/// Where the wheel is when its odometer, cut towards zero, shows this.
Range range_of(std::int64_t odometer_cm) {
  const double shown_m = kUnit_m * static_cast<double>(odometer_cm);
  return {odometer_cm > 0 ? shown_m : shown_m - kUnit_m,
          odometer_cm < 0 ? shown_m : shown_m + kUnit_m};
}

}  // namespace

double WheelTravel::add(double dt_s, double speed, std::int64_t odometer_cm) {
  const Range range = range_of(odometer_cm);
  const double before_m = rolled_m_.value_or(0.0);
  const double speed_before = speed_;
  speed_ += (1.0 - std::exp(-dt_s / kSmoothing_s)) * (speed - speed_);
  last_ = {dt_s, 0.0, speed != 0.0 || odometer_cm != odometer_cm_};
  odometer_cm_ = odometer_cm;
  const double expected_m = before_m + 0.5 * (speed_before + speed_) * dt_s;
  const double held_m = std::clamp(expected_m, range.low_m, range.high_m);
  const bool jumped =
      rolled_m_ && std::abs(held_m - before_m) > max_speed_ * (dt_s + kLateness_s) + kRounding_m;
  if (jumped) ++restarts_;
  if (!rolled_m_ || jumped) {
    rolled_m_ = 0.5 * (range.low_m + range.high_m);
    return 0.0;
  }
  rolled_m_ = held_m;
  last_.rolled_m = held_m - before_m;
  return last_.rolled_m;
}

}  // namespace mocha
