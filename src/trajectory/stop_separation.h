#pragma once

#include <limits>
#include <optional>

#include "trajectory/braking.h"
#include "trajectory/motion.h"

namespace mocha {

/// A motion, and how its robot brakes along it. The motion must outlive this.
struct BrakableMotion {
  const Motion& motion;
  Braking braking;
  double mistimed_s = 0.0;  ///< it may be early or late by so much
};

/// A stop by which two robots come too close.
struct StopMeeting {
  double brakes_s;    ///< absolute; the one brakes then, the other after the reaction time
  double time_s;      ///< absolute; they are close then
  double distance_m;  ///< centre to centre
  Vector2 place;      ///< [m] of robot a then, map frame
};

/// The first moment in [from_s, until_s] at which either robot cannot brake along its path without
/// that they come closer than `distance_m`, centre to centre, though the other robot brakes along
/// its own path `reaction_s` later; motions that may be early or late are kept apart by so much
/// more (Mistiming). The verdict on (b, a) is that on (a, b).
///
/// Moments and places are 0.1 s apart and joined by straight lines; what is accepted holds to
/// within 2 cm for accelerations up to 2 m/s^2. Robots brake as brake_along() does. Throws
/// std::invalid_argument for empty motions, and for a reaction time that is negative or above 10 s.
std::optional<StopMeeting> first_stop_meeting(
    const BrakableMotion& a, const BrakableMotion& b, double distance_m, double reaction_s,
    double from_s, double until_s = std::numeric_limits<double>::infinity());

}  // namespace mocha
