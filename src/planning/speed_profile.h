#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/robot_model.h"

namespace mocha {

/// Knots on a front-end path and durations between them, from which an optimisation starts.
struct InitialKnots {
  Eigen::Matrix2Xd path;        ///< start, interior knots, end [m]
  Eigen::VectorXd durations_s;  ///< one fewer than points
};

/// Drives along straight lines at a trapezoidal speed profile, slower in corners, and puts knots at
/// uniform TIME, so that slow stretches get more of them.
///
/// Throws std::invalid_argument for fewer than two points. The path begins at `start_speed` [m/s]
/// and ends at rest; the knots are about `spacing_m` apart at full speed.
InitialKnots spread_knots(const std::vector<Vector2>& points, double start_speed,
                          const MotionLimits& limits, double spacing_m);

}  // namespace mocha
