#pragma once

#include "trajectory/motion.h"

namespace mocha {

/// The driven part of a short time: arc length [m] and turn [rad].
struct Arc {
  double length_m = 0.0;
  double turn_rad = 0.0;
};

/// The pose at the end of an arc of constant curvature.
Pose advanced(const Pose& pose, const Arc& arc);

/// The arc of constant curvature from one pose to the next, if the robot drove one and turned by
/// less than half a turn.
Arc arc_between(const Pose& from, const Pose& to);

}  // namespace mocha
