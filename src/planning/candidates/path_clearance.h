#pragma once

#include "world/robot_model.h"

namespace mocha {

/// Around its start, a detour may be as close to obstacles as the start is [m].
inline constexpr double kEscapeRadius_m = 0.6;

/// By so much do paths keep more distance than is proved, for the optimiser to work in [m].
inline constexpr double kPathSlack_m = 0.01;

/// Paths keep the robot's base so far from what stands [m]: with less, no motion passes, whatever
/// the heading is and however slow it is.
double path_clearance_m(const RobotModel& robot);

/// The narrowest gap of the map that paths lead through, slowly [m].
double passable_gap_m(const RobotModel& robot);

/// The width of the place in which the robot turns on the spot [m].
double turning_room_m(const RobotModel& robot);

/// Drives get no slower than that through narrow places [m/s].
inline constexpr double kCreep_mps = 0.1;

}  // namespace mocha
