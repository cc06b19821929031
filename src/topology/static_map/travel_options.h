#pragma once

#include <tuple>

namespace mocha {

/// What a metre of path costs.
struct TravelOptions {
  double required_clearance_m;   ///< of the robot's centre; closer is forbidden
  double preferred_clearance_m;  ///< closer than this costs more
  double clearance_weight;       ///< relative extra cost at zero distance
  double escape_radius_m;        ///< around the start, places no closer than the start are allowed
  /// By so much more than required must a place have for the highest speed; with less, the speed
  /// falls with its square root to the slowest share of that, and a metre costs as much more as it
  /// takes longer.
  double room_for_speed_m = 0.0;
  double slowest_share = 1.0;

  bool operator==(const TravelOptions& other) const {
    return std::tie(required_clearance_m, preferred_clearance_m, clearance_weight, escape_radius_m,
                    room_for_speed_m, slowest_share) ==
           std::tie(other.required_clearance_m, other.preferred_clearance_m, other.clearance_weight,
                    other.escape_radius_m, other.room_for_speed_m, other.slowest_share);
  }
};

}  // namespace mocha
