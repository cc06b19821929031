#pragma once

#include "planning/candidates/maneuver.h"

namespace mocha {

// Braking along the committed motion. Each returns at most one maneuver.

/// As soon as the robot may: at once where no peer is near, else after settling. Braking late
/// leaves nothing to a thing that then comes faster than it was expected to.
Maneuvers brake_soon(const ManeuverStart& start);

/// As late as can be certified, but with time to settle.
Maneuvers brake_in_time(const ManeuverStart& start);

/// The same, where there is no time to settle.
Maneuvers brake_in_time_at_once(const ManeuverStart& start);

/// At once, as hard as emergency motions may.
Maneuvers brake_hard(const ManeuverStart& start);

}  // namespace mocha
