#pragma once

#include <Eigen/Core>

#include "trajectory/bernstein.h"

namespace mocha {

/// Control points (columns) of a polynomial piece with C coefficients, by time: the curve, its
/// velocity and its acceleration stay within the convex hulls of theirs, and the first and last are
/// the values at the ends.
template <int D, int C>
struct PieceHull {
  Eigen::Matrix<double, D, C> position;          ///< [m]
  Eigen::Matrix<double, D, C - 1> velocity;      ///< [m/s]
  Eigen::Matrix<double, D, C - 2> acceleration;  ///< [m/s^2]
};

/// From the coefficients of a piece in normalised time and its duration. Made to cull: differences
/// of control points become control points by running sums, highest derivative first, so that the
/// derivatives lose nothing far from the origin.
template <int D, int C>
EIGEN_ALWAYS_INLINE PieceHull<D, C> piece_hull(const Eigen::Matrix<double, D, C>& piece,
                                               double duration_s) {
  constexpr int kDegree = C - 1;
  const double rate = kDegree / duration_s;
  const double rate_squared = (kDegree - 1) * rate / duration_s;
  Eigen::Matrix<double, D, C - 2> second;  // differences of order 2
  for (int k = 0; k < C - 2; ++k) second.col(k) = 1.0 / binomial(kDegree, k + 2) * piece.col(k + 2);
  for (int level = 1; level < C - 2; ++level) {
    for (int k = C - 3; k >= level; --k) second.col(k) += second.col(k - 1);
  }
  PieceHull<D, C> hull;
  Eigen::Matrix<double, D, 1> first = 1.0 / kDegree * piece.col(1);  // difference of order 1
  hull.position.col(0) = piece.col(0);
  for (int k = 0; k < C - 1; ++k) {
    hull.position.col(k + 1) = hull.position.col(k) + first;
    hull.velocity.col(k) = rate * first;
    if (k == C - 2) break;
    hull.acceleration.col(k) = rate_squared * second.col(k);
    first += second.col(k);
  }
  return hull;
}

}  // namespace mocha
