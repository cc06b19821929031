#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// What holds all along one piece of a trajectory, from the hulls of its Bernstein control points.
template <int D>
struct PieceBounds {
  Eigen::AlignedBox<double, D> box;  ///< of the positions [m]
  double min_speed2;                 ///< lower bound [m^2/s^2]
  double max_speed2;                 ///< upper bounds
  double max_acceleration2;          ///< [m^2/s^4]
  double start_s;                    ///< from the start of the trajectory
  double duration_s;
};

/// Bounds of a piece in normalised time that lasts `duration_s` > 0.
template <int D, int S>
PieceBounds<D> bounds_of(const Eigen::Matrix<double, D, 2 * S>& piece, double start_s,
                         double duration_s);

}  // namespace mocha
