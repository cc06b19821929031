#pragma once

#include <optional>
#include <vector>

#include "trajectory/motion.h"
#include "world/robot_model.h"

namespace mocha {

/// A slow drive backward along the way the robot came, from rest to rest: how it leaves a place
/// where nothing ahead can be planned.
///
/// `trail` holds the places that the robot came through (map frame, newest last); the motion begins
/// at `pose` at `start_time_s` and follows the trail for about `length_m`. Nothing where the robot
/// did not come from behind, or where the motion would break its limits, as that of a robot which
/// cannot drive backward does. Clearance is left to the caller's proof.
std::optional<Motion> back_out_along(const std::vector<Vector2>& trail, const Pose& pose,
                                     double start_time_s, double length_m,
                                     const MotionLimits& limits);

}  // namespace mocha
