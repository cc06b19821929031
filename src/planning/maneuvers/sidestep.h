#pragma once

#include "planning/candidates/maneuver.h"

namespace mocha {

/// Motions that brake where need be and then step aside, out of the way of what moves, to rest: a
/// turn in place and a straight drive, forward or (where it can) backward, to a place within two
/// metres that stays free. The most promising first, some ten of them at most; all of them are
/// settled.
Maneuvers sidesteps(const ManeuverStart& start);

/// The same within the limits of an emergency; those that bind at once come with them where no peer
/// is near.
Maneuvers hard_sidesteps(const ManeuverStart& start);

}  // namespace mocha
