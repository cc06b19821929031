#pragma once

#include <limits>

namespace mocha {

/// Room to keep that grows with the speed: what moves slowly strays less and stops sooner.
struct SpeedMargin {
  double still_m = 0.0;      ///< at rest
  double per_speed_s = 0.0;  ///< more for each m/s [m / (m/s)]

  /// The same at every speed, unless more is said.
  SpeedMargin(double at_rest_m = 0.0, double more_per_speed_s = 0.0)
      : still_m(at_rest_m), per_speed_s(more_per_speed_s) {}

  /// [m], at a speed >= 0 [m/s].
  double at(double speed) const { return still_m + per_speed_s * speed; }

  /// The highest speed [m/s] at which it fits into so much room; below 0 where it does not even at
  /// rest.
  double fastest(double room_m) const {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    if (per_speed_s > 0.0) return (room_m - still_m) / per_speed_s;
    return room_m >= still_m ? kAny : -kAny;
  }
};

}  // namespace mocha
