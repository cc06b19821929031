#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "trajectory/piece_hull.h"

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
/// place: a copy just after the entries were written stalls, and this is asked of every piece.
template <int D, int C>
void set_bounds(const Eigen::Matrix<double, D, C>& piece, double start_s, double duration_s,
                PieceBounds<D>& bounds) {
  const PieceHull<D, C> hull = piece_hull(piece, duration_s);
  const Eigen::Matrix<double, D, 1> ahead = hull.position.col(C - 1) - hull.position.col(0);
  const double least_ahead = std::max(0.0, (ahead.transpose() * hull.velocity).minCoeff());
  constexpr double kTiny = 1e-100;  // keeps the quotient finite where there is no way ahead
  bounds.box = {hull.position.rowwise().minCoeff(), hull.position.rowwise().maxCoeff()};
  bounds.min_speed2 = least_ahead * least_ahead / std::max(ahead.squaredNorm(), kTiny);
  bounds.max_speed2 = hull.velocity.colwise().squaredNorm().maxCoeff();
  bounds.max_acceleration2 = hull.acceleration.colwise().squaredNorm().maxCoeff();
  bounds.start_s = start_s;
  bounds.duration_s = duration_s;
}

}  // namespace mocha
