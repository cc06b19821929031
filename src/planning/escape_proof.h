#pragma once

#include "safety/certificate.h"

namespace mocha {

// Proofs for robots that may already be closer than they should, because the map got better or a
// team-mate stopped near by. Such a robot may stay and may leave: until it has regained the margin,
// it must not come closer than it is.

/// Clearance as check_clearance() proves it, with that exception.
Violation check_clearance_or_leaving(const Motion& motion, const Footprint& footprint,
                                     const ObstacleField<2>& field, double margin_m, double from_s);

/// Separation as check_separation() proves it until `until_s`, with that exception.
Violation check_separation_or_leaving(const Motion& motion, double own_radius_m,
                                      const MovingObstacle& other, double clearance_m,
                                      double from_s, double until_s);

}  // namespace mocha
