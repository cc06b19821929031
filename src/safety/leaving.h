#pragma once

#include <algorithm>

#include "safety/certificate.h"

namespace mocha {

// Proofs for robots that may already be closer than they should, because the map got better or a
// peer stopped near by.

/// How a motion that begins closer to obstacles than its margin may go on: the gap grows along the
/// way, as on an arc that leaves a wall, with the square of the way. That is asked from every place
/// of the way on, and of every turn in place; so room that was gained is never lost, and what is
/// certified once is certified at every later moment, too.
struct Leaving {
  /// What a gap may lose [m]: a body beside a wall cannot turn away from it with less.
  static constexpr double kTurnAway_m = 0.006;

  double way_m = 1.0;  ///< after which the gap is the margin; above 0

  /// The gap [m] to have `way_m` after a place where it was `gap_m`.
  double required_m(double gap_m, double after_m, double margin_m) const {
    const double share = std::min(after_m / way_m, 1.0);
    const double least_m = std::min(gap_m - kTurnAway_m, margin_m);
    return least_m + share * share * (margin_m - least_m);
  }
};

/// Clearance as check_clearance() proves it, with that exception. It does not hold for a robot
/// whose cover reaches more than 4 cm into an obstacle.
Violation check_clearance_or_leaving(const Motion& motion, const Footprint& footprint,
                                     const ObstacleField<2>& field, double margin_m,
                                     const Leaving& leaving, double from_s);

/// Separation as check_separation() proves it until `until_s`, with one exception: until the robot
/// has regained the clearance, it does not come closer than it is.
Violation check_separation_or_leaving(const Motion& motion, double own_radius_m,
                                      const MovingObstacle& other, double clearance_m,
                                      double from_s, double until_s);

}  // namespace mocha
