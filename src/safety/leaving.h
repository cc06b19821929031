#pragma once

#include <algorithm>
#include <cmath>

#include "safety/certificate.h"

namespace mocha {

// Proofs for robots that may already be closer than they should, because the map got better or a
// peer stopped near by.

/// How a motion that begins closer to obstacles than its margin may go on. What counts is the room
/// that it has: the gap, less what the margin asks for the speed; so a robot that is too close
/// leaves slowly. It may lose a little of its room, beside a wall it cannot turn away with less, or
/// all but half of the margin, where a passage is so narrow; and after some way it has the margin.
/// What is certified once is certified at every later moment, too.
struct Leaving {
  /// The room [m] that a motion may lose, and half of what there is at most.
  static constexpr double kLoss_m = 0.006;

  /// Proofs may refuse what is within a millimetre of its limit: the room is taken to be so much
  /// less than it is found [m]. So much may each motion lose in any case.
  static constexpr double kSlack_m = 0.003;

  double way_m = 1.0;  ///< after which the room is the margin at rest; above 0
  /// So far may the cover of the body reach into cells of the map, which overstate what is there.
  double deepest_m = 0.04;

  /// The room [m] to have on the way, where it was `room_m` at most since the motion began, for a
  /// margin at rest.
  double required_m(double room_m, double margin_m) const {
    const double lost_m = std::min(kLoss_m, 0.5 * std::max(0.0, room_m));
    return std::min(room_m - lost_m, 0.5 * margin_m);
  }
};

/// Clearance as check_clearance() proves it, with that exception. It does not hold for a robot
/// whose cover reaches into an obstacle by more than a map overstates.
Violation check_clearance_or_leaving(const Motion& motion, const Footprint& footprint,
                                     const ObstacleField<2>& field, const SpeedMargin& margin,
                                     const Leaving& leaving, double from_s);

/// Separation as check_separation() proves it until `until_s`, with one exception: until the robot
/// has regained the clearance, it does not come closer than it is.
Violation check_separation_or_leaving(const Motion& motion, double own_radius_m,
                                      const MovingObstacle& other, double clearance_m,
                                      double from_s, double until_s);

}  // namespace mocha
