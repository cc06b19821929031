#pragma once

#include <cmath>
#include <limits>

namespace mocha {

/// Room to keep that grows with the square of the speed, as the way to stop does: what moves slowly
/// strays less and stops sooner.
struct SpeedMargin {
  double still_m = 0.0;     ///< at rest
  double per_speed2 = 0.0;  ///< more for each (m/s)^2 [s^2/m]

  /// The same at every speed, unless more is said.
  SpeedMargin(double at_rest_m = 0.0, double more_per_speed2 = 0.0)
      : still_m(at_rest_m), per_speed2(more_per_speed2) {}

  /// [m], at a speed [m/s].
  double at(double speed) const { return still_m + per_speed2 * speed * speed; }

  /// The highest speed [m/s] at which it fits into so much room; below 0 where it does not even at
  /// rest.
  double fastest(double room_m) const {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    if (room_m < still_m) return -kAny;
    return per_speed2 > 0.0 ? std::sqrt((room_m - still_m) / per_speed2) : kAny;
  }
};

}  // namespace mocha
