#pragma once

#include "planning/candidates/maneuver.h"

namespace mocha {

/// A way out between all that moves, found by a search in space and time over what a unicycle can
/// do in the next seconds within the limits of an emergency (hybrid A*), forward only: turning to
/// either side, faster, at its speed or braking, again and again, and at last braking to rest. It
/// keeps as much room as it can, in three steps; of the ways that keep as much, it gets the nearest
/// to where the committed motion leads. It binds at once, and so is none where a peer is near; none
/// where the robot drives backward.
Maneuvers escape_searches(const ManeuverStart& start);

}  // namespace mocha
