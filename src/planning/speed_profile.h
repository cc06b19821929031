#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/robot_model.h"

namespace mocha {

/// Knots on a front-end path and durations between them, from which an optimisation starts.
template <int D>
struct InitialKnots {
  Eigen::Matrix<double, D, Eigen::Dynamic> path;  ///< start, interior knots, end [m]
  Eigen::VectorXd durations_s;                    ///< one fewer than points
};

/// Drives along straight lines at a trapezoidal speed profile, slower in corners, and puts knots at
/// uniform TIME, so that slow stretches get more of them.
///
/// Throws std::invalid_argument for fewer than two points. The path begins at `start_speed` [m/s]
/// and ends at rest; the knots are about `spacing_m` apart at full speed.
template <int D>
InitialKnots<D> spread_knots(const std::vector<Eigen::Matrix<double, D, 1>>& points,
                             double start_speed, const MotionLimits& limits, double spacing_m);

extern template InitialKnots<2> spread_knots<2>(const std::vector<Eigen::Vector2d>&, double,
                                                const MotionLimits&, double);
extern template InitialKnots<3> spread_knots<3>(const std::vector<Eigen::Vector3d>&, double,
                                                const MotionLimits&, double);

}  // namespace mocha
