#pragma once

#include <limits>
#include <optional>

#include "trajectory/motion.h"

namespace mocha {

/// The moment at which two motions are closest, centre to centre.
struct ClosestApproach {
  double distance_m;
  double time_s;  ///< absolute
};

// Both questions are answered in continuous time by conservative advancement: from the distance d,
// its rate d' and a bound A on the relative acceleration follows d(t + h) >= d + d' h - A h^2 / 2,
// so a step that keeps this above the distance in question skips nothing. Before its start a robot
// stands at the start, after its end it stands at the end.

/// The smallest distance over [t0, t1]; at most `tolerance_m` above the true one. t1 may be
/// infinite.
ClosestApproach closest_approach(const Motion& a, const Motion& b, double t0, double t1,
                                 double tolerance_m = 1e-3);

/// The first time in [t0, t1] at which the centres are closer than `distance_m` (or within 0.5 mm
/// of it). Proved: without an answer there is no such time. Throws std::invalid_argument for what
/// is not a number.
std::optional<double> first_time_closer_than(const Motion& a, const Motion& b, double distance_m,
                                             double t0,
                                             double t1 = std::numeric_limits<double>::infinity());

/// Whether the places of the two motions are at least this far apart at all times, told by their
/// boxes: cheap, and no answer to the contrary.
bool far_apart(const Motion& a, const Motion& b, double distance_m);

/// Upper bounds over a whole motion, from control points.
struct MotionBounds {
  double speed;         ///< [m/s]
  double acceleration;  ///< [m/s^2]
};
MotionBounds bounds(const Motion& motion);

}  // namespace mocha
