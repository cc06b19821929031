#pragma once

#include <algorithm>

#include "safety/certificate.h"

namespace mocha {

// Proofs for robots that may already be closer than they should, because the map got better or a
// peer stopped near by.

/// How a motion that begins closer to obstacles than its margin may go on. What counts is the room
/// that it has: the gap, less what the margin asks for the speed; so a robot that is too close may
/// gain room by driving away and by slowing down, and leaves slowly. The room grows along the way,
/// as the gap does on an arc that leaves a wall, with the square of the way. That is asked from
/// every place of the way on, and of every turn in place; so room that was gained is never lost,
/// and what is certified once is certified at every later moment, too.
struct Leaving {
  /// What the room may lose [m] while the body turns: beside a wall it cannot turn away with less.
  static constexpr double kTurnAway_m = 0.006;
  /// And however it moves, for the speed that it needs in order to move at all.
  static constexpr double kSetOff_m = 0.002;

  /// The room [m] below which nothing may be lost, so that losses of many motions end ...
  static constexpr double kLeast_m = 0.004;
  /// ... and the same where the map has obstacles in the robot's place: it overstates them.
  static constexpr double kLeastInside_m = -0.03;

  double way_m = 1.0;  ///< after which the room is the margin at rest; above 0

  /// The room [m] to have `after_m` of way, on which a corner turned by `turned_m`, after a place
  /// where it was `room_m`, for a margin at rest.
  double required_m(double room_m, double after_m, double turned_m, double margin_m) const {
    const double share = std::min(after_m / way_m, 1.0);
    const double lost_m = std::min(kTurnAway_m, kSetOff_m + turned_m);
    const double floor_m = room_m > -kLeast_m ? kLeast_m : kLeastInside_m;
    const double least_m = std::min(std::max(room_m - lost_m, std::min(room_m, floor_m)), margin_m);
    return least_m + share * share * (margin_m - least_m);
  }
};

/// Clearance as check_clearance() proves it, with that exception. It does not hold for a robot
/// whose cover reaches more than 4 cm into an obstacle.
Violation check_clearance_or_leaving(const Motion& motion, const Footprint& footprint,
                                     const ObstacleField<2>& field, const SpeedMargin& margin,
                                     const Leaving& leaving, double from_s);

/// Separation as check_separation() proves it until `until_s`, with one exception: until the robot
/// has regained the clearance, it does not come closer than it is.
Violation check_separation_or_leaving(const Motion& motion, double own_radius_m,
                                      const MovingObstacle& other, double clearance_m,
                                      double from_s, double until_s);

}  // namespace mocha
