#pragma once

#include <limits>

#include "safety/violation.h"
#include "trajectory/motion.h"
#include "world/footprint.h"
#include "world/moving/moving_obstacle.h"
#include "world/obstacle_field.h"
#include "world/robot_model.h"
#include "world/speed_margin.h"
#include "world/speed_zones.h"

namespace mocha {

// Each check proves its property for all times from `from_s` (absolute) on, in continuous time, and
// returns the first violation; a motion that begins later is checked from its start. What is
// accepted holds; what is refused is violated or within rounding distance of it: 1 mm for
// distances, a share of 1e-6 for limits.

/// Speed, acceleration, yaw rate and direction of drives; yaw rate and yaw acceleration of turns in
/// place.
Violation check_limits(const Motion& motion, const MotionLimits& limits, double from_s);

/// Speed in the zones. Motions within 1 mm/s of a zone's limit may be refused, too.
Violation check_speed_zones(const Motion& motion, const SpeedZones& zones, double from_s);

/// What the footprint keeps to the obstacles of the field at a pose [m], never overstated; below 0
/// where it overlaps them, or its cover does.
double clearance_m(const Pose& pose, const Footprint& footprint, const ObstacleField<2>& field);

/// The footprint's cover discs keep the margin of the base's speed to all obstacles of the field,
/// until `until_s`.
Violation check_clearance(const Motion& motion, const Footprint& footprint,
                          const ObstacleField<2>& field, const SpeedMargin& margin, double from_s,
                          double until_s = std::numeric_limits<double>::infinity());

/// The disc of `own_radius_m` keeps `clearance_m` to the obstacle's disc, until both rest or
/// `until_s`, whichever is first. Throws std::invalid_argument if neither is finite.
Violation check_separation(const Motion& motion, double own_radius_m,
                           const MovingObstacle& obstacle, double clearance_m, double from_s,
                           double until_s = std::numeric_limits<double>::infinity());

}  // namespace mocha
