#pragma once

#include <vector>

#include "trajectory/motion.h"
#include "world/robot_model.h"

namespace mocha {

/// What is left to a robot under way besides braking along its path: to turn off to either side,
/// faster, at its speed or braking, and then to brake to rest. All of them leave
/// `committed` at `start_time_s`, a switch time of it, and end at rest; none where the robot hardly
/// moves then. They are made for `limits` and keep them but for what the interpolation leaves:
/// that, and all else, is for the caller to prove.
std::vector<Motion> dodges(const Motion& committed, double start_time_s,
                           const MotionLimits& limits);

}  // namespace mocha
