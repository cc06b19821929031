#pragma once

#include "planning/candidates/drive_optimizer.h"

namespace mocha {

/// Knots of a path whose times are given, at even times, speed and direction averaged over
/// `window_s`: so they change gradually, also from and to what they are at the ends.
InitialKnots<2> even_knots(const DriveQuery& query, int pieces, double window_s);

}  // namespace mocha
