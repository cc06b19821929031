#pragma once

#include <optional>
#include <vector>

#include "planning/candidates/speed_profile.h"
#include "trajectory/motion.h"
#include "world/robot_model.h"

namespace mocha {

/// How a path is to be driven as it is, from rest to rest.
struct PathDrive {
  int direction;         ///< +1 forward, -1 backward
  Vector2 first_course;  ///< unit direction of travel where it begins
  Vector2 last_course;   ///< the same where it ends
  double spacing_m;      ///< of the knots, about; corners are rounded over that
  MotionLimits wanted;   ///< of speed and acceleration; what the robot may do is asked for besides
  SpeedAt<2> fastest_at = {};  ///< how fast a place lets it be; may be empty
};

/// The drive along at least two points, map frame. Slower than wanted where the path asks for more
/// yaw rate than `limits` allow; nothing where that would have to be by far.
std::optional<DrivePhase> drive_along(const std::vector<Vector2>& path, const PathDrive& how,
                                      const MotionLimits& limits);

}  // namespace mocha
