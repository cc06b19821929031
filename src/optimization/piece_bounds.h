#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "trajectory/bernstein.h"

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

/// Sets the bounds of a piece of C coefficients in normalised time that lasts `duration_s` > 0. In
/// place, as copying them would take a third as long again.
template <int D, int C>
void set_bounds(const Eigen::Matrix<double, D, C>& piece, double start_s, double duration_s,
                PieceBounds<D>& bounds) {
  const Bernstein<D, C - 1> position = to_bernstein(piece);
  const Bernstein<D, C - 2> course = derivative(position);
  const Bernstein<D, C - 3> bend = derivative(course);
  const Eigen::Matrix<double, D, 1> ahead = position.col(C - 1) - position.col(0);
  const double least_ahead = std::max(0.0, (ahead.transpose() * course).minCoeff());
  // One division for both quotients; kTiny keeps it finite where there is no way ahead.
  constexpr double kTiny = 1e-100;
  const double ahead2 = std::max(ahead.squaredNorm(), kTiny);
  const double quotient = 1.0 / (duration_s * duration_s * ahead2);
  const double inverse2 = quotient * ahead2;
  bounds.box = {position.rowwise().minCoeff(), position.rowwise().maxCoeff()};
  bounds.min_speed2 = least_ahead * least_ahead * quotient;
  bounds.max_speed2 = course.colwise().squaredNorm().maxCoeff() * inverse2;
  bounds.max_acceleration2 = bend.colwise().squaredNorm().maxCoeff() * inverse2 * inverse2;
  bounds.start_s = start_s;
  bounds.duration_s = duration_s;
}

}  // namespace mocha
