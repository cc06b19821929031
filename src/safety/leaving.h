#pragma once

#include "safety/certificate.h"

namespace mocha {

// Proofs for robots that may already be closer than they should, because the map got better or a
// peer stopped near by.

/// How a motion that begins closer to obstacles than its margin may go on: the gap grows along the
/// way as on an arc that leaves a wall, with the square of the way, to all of the margin after a
/// metre. That is asked from every place of the way on, and of every turn in place; so room that
/// was gained is never lost, and what is certified once is certified at every later moment, too.
struct Leaving {
  /// The gap [m] that it has to have after 0.3 m already: the tracking error, below which a
  /// contact cannot be excluded.
  double floor_m = 0.0;
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
