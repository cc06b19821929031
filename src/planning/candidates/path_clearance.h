#pragma once

#include "world/robot_model.h"

namespace mocha {

/// Around its start, a path may be as close to obstacles as the start is [m].
inline constexpr double kEscapeRadius_m = 0.6;

/// By so much do paths keep more distance than is proved, for the optimiser to work in [m].
inline constexpr double kPathSlack_m = 0.01;

/// Paths keep the robot's centre so far from what stands [m]: room for the widest disc of its
/// footprint.
double path_clearance_m(const RobotModel& robot);

}  // namespace mocha
