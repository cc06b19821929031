#pragma once

#include <optional>

#include "planning/candidates/speed_profile.h"
#include "trajectory/minco.h"
#include "trajectory/motion.h"

namespace mocha {

/// The knots of what is left of a motion from a time on, where that is one drive forward that
/// begins about as `start` (position, velocity, acceleration) and ends about at `end`; else
/// nothing. The ends are put where these say.
std::optional<InitialKnots<2>> remaining_knots(const Motion& motion, double from_s,
                                               const PlanarMinco::State& start, const Vector2& end);

}  // namespace mocha
