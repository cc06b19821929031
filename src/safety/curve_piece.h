#pragma once

#include <algorithm>
#include <vector>

#include "trajectory/bernstein.h"
#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// One polynomial piece of degree N in Bernstein form, by its own normalised time.
template <int D, int N>
struct CurvePiece {
  double start_s;
  double duration_s;
  Bernstein<D, N> position;      ///< [m]
  Bernstein<D, N - 1> velocity;  ///< [m] by normalised time

  double end_s() const { return start_s + duration_s; }
  /// An upper bound [m/s].
  double max_speed() const { return velocity.colwise().norm().maxCoeff() / duration_s; }
};

/// The velocity of a piece by its normalised time: from its own coefficients, not from differences
/// of positions, whose rounding grows with the distance from the origin.
template <int D, int C>
Bernstein<D, C - 2> velocity_of(const Eigen::Matrix<double, D, C>& coefficients) {
  Eigen::Matrix<double, D, C - 1> rate;
  for (int k = 1; k < C; ++k) rate.col(k - 1) = k * coefficients.col(k);
  return to_bernstein(rate);
}

/// The pieces of a curve that begins at `start_s`, from `from_s` on; a piece under way at `from_s`
/// is cut there.
template <int D, int S>
std::vector<CurvePiece<D, 2 * S - 1>> curve_pieces(const PiecewisePolynomial<D, S>& curve,
                                                   double start_s, double from_s) {
  constexpr double kShortest_s = 1e-6;  // a shorter rest of a piece is lost in rounding
  std::vector<CurvePiece<D, 2 * S - 1>> pieces;
  pieces.reserve(curve.pieces());
  for (int i = 0; i < curve.pieces(); ++i) {
    const double tau = curve.piece_duration(i);
    // What is left is a share of tau, not a difference of absolute times, which are coarse: all
    // speeds would be wrong by the error of the quotient.
    const double over = std::max(0.0, (from_s - start_s - curve.piece_start(i)) / tau);
    const double left_s = (1.0 - over) * tau;
    if (over > 0.0 && left_s < kShortest_s) continue;
    auto position = to_bernstein(curve.piece(i));
    auto velocity = velocity_of(curve.piece(i));
    if (over > 0.0) {
      position = split(position, over).second;
      velocity = (1.0 - over) * split(velocity, over).second;
    }
    pieces.push_back({start_s + (curve.piece_start(i) + over * tau), left_s, position, velocity});
  }
  return pieces;
}

}  // namespace mocha
