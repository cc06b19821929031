#pragma once

#include "planning/candidates/maneuver.h"

namespace mocha {

/// Ways on between all that moves, towards the target, well within the usual limits; see
/// rolling_search.h. They bind at once where no peer is near, and are settled else.
Maneuvers weaves(const ManeuverStart& start);

/// A way out within the limits of an emergency, which keeps as much room as it can, in three steps.
/// It binds at once, and so is none where a peer is near.
Maneuvers ways_out(const ManeuverStart& start);

}  // namespace mocha
