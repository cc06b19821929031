#pragma once

#include <limits>
#include <vector>

#include "planning/candidates/maneuver.h"
#include "safety/violation.h"

namespace mocha {

/// Paper (37): the first moment in [from_s, from_s + mu_pre_s] at which a plan comes closer to
/// something that moves than is to be kept from it; no violation if there is none. `own_radius_m`
/// is part of what is kept, and only tells the body from the clearance in the result.
///
/// The offsets at which distances are looked at are chosen so that nothing slips through between
/// them: after a distance d more than is to be kept, the next look comes no later than d over the
/// highest speeds at which the robot drives and the disc moves and grows together. No two discs,
/// and however fast, can meet in less.
Violation conflict_of(const Motion& plan, const std::vector<MovingThing>& moving,
                      double own_radius_m, double from_s, double mu_pre_s);

/// Things that never rest count for good in the search for a motion, though nothing about them is
/// proved so far ahead: else it would pay to wait until they are forgotten.
std::vector<MovingThing> foreseen(std::vector<MovingThing> things);

/// How far, at its worst in [from_s, until_s], a motion is from what is kept from all that moves
/// [m]; negative where it comes closer. Sampled: it compares motions of which none can be proved.
/// Below `of_no_use_m` it is not looked for exactly.
double least_room_m(const Motion& motion, const std::vector<MovingThing>& moving, double from_s,
                    double until_s, double of_no_use_m = -std::numeric_limits<double>::infinity());

/// What an escape looks at: what the committed motion or hard braking meets, for good; all else as
/// long as it is predicted, for where it is then is a guess.
std::vector<MovingThing> exposed_to(const ManeuverStart& start, double from_s);

}  // namespace mocha
