#pragma once

#include <cmath>
#include <optional>

#include "safety/curve_piece.h"
#include "safety/violation.h"

namespace mocha {

/// What is accepted exceeds its limit by no more than this share.
constexpr double kLimitSlack = 1.0 + 1e-6;

/// The first violation in one piece or turn, the earliest of those considered.
struct Earliest {
  ViolatedTerm term = ViolatedTerm::kNothing;
  double u = 2.0;      ///< normalised time
  bool jumps = false;  ///< there is no rate to speak of: what it is the rate of jumps

  explicit operator bool() const { return term != ViolatedTerm::kNothing; }

  void consider(ViolatedTerm candidate, const std::optional<double>& at) {
    if (at && *at < u) {
      term = candidate;
      u = *at;
    }
  }
};

/// Where a vector's norm exceeds a limit.
template <int D, int C>
std::optional<double> first_above(const Eigen::Matrix<double, D, C>& vector, double limit) {
  Eigen::Matrix<double, 1, 2 * C - 1> excess = squared_norm(vector);
  excess.array() -= limit * limit;
  return first_positive(excess);
}

/// The first violation of the limits of speed [m/s] and acceleration [m/s^2].
template <int D, int N>
Earliest first_excess(const CurvePiece<D, N>& piece, double max_speed, double max_acceleration) {
  const double tau = piece.duration_s;
  Earliest first;
  first.consider(ViolatedTerm::kSpeed, first_above(piece.velocity, kLimitSlack * max_speed * tau));
  first.consider(
      ViolatedTerm::kAcceleration,
      first_above(derivative(piece.velocity), kLimitSlack * max_acceleration * tau * tau));
  return first;
}

/// Where two pieces do not meet at the knot between them, at the start of the second. As between
/// the phases of a motion, 1 mm and 0.01 m/s count as meeting.
template <int D, int N>
Earliest first_jump(const CurvePiece<D, N>& before, const CurvePiece<D, N>& after) {
  constexpr double kPlace_m = 1e-3;
  constexpr double kVelocity = 0.01;  // [m/s]
  const double apart = (after.position.col(0) - before.position.col(N)).norm();
  if (!(apart <= kPlace_m)) return {ViolatedTerm::kSpeed, 0.0, true};
  const double change =
      (after.velocity.col(0) / after.duration_s - before.velocity.col(N - 1) / before.duration_s)
          .norm();
  if (!(change <= kVelocity)) return {ViolatedTerm::kAcceleration, 0.0, true};
  return {};
}

}  // namespace mocha
