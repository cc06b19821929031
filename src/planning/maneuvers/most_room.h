#pragma once

#include "planning/candidates/maneuver.h"

namespace mocha {

// What is left where nothing keeps clear of what moves.

/// The sidesteps and swerves within the limits of an emergency that keep more room to the likely
/// course of what moves than braking hard, going on, or a contact would: the most room first, and
/// where that is enough, the soonest done.
Maneuvers most_room(const ManeuverStart& start);

/// To brake hard; nothing, which means to go on with what is committed, where that keeps more room
/// or the robot stands.
Maneuvers last_resort(const ManeuverStart& start);

}  // namespace mocha
