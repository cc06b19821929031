#pragma once

#include "world/robot_model.h"

namespace mocha {

/// Around its start, a path may be as close to obstacles as the start is [m].
inline constexpr double kEscapeRadius_m = 0.6;

/// By so much do paths keep more distance than is proved, for the optimiser to work in [m].
inline constexpr double kPathSlack_m = 0.01;

/// Paths keep the robot's base so far from what stands [m]: with less, no motion passes, whatever
/// the heading is.
double path_clearance_m(const RobotModel& robot);

}  // namespace mocha
