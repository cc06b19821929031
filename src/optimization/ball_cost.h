#pragma once

#include "optimization/penalty.h"

namespace mocha {

/// A disc (D = 2) or ball (D = 3) at one moment, as large as one wishes to keep away from it.
template <int D>
struct MovingBall {
  using Vector = Eigen::Matrix<double, D, 1>;

  Vector centre;       ///< [m]
  Vector velocity;     ///< [m/s]
  double radius_m;     ///< d_s, above 0
  double radius_rate;  ///< [m/s]
};

/// Adds the weighted phi(1 - d^2 / d_s^2) of paper (33)(39) and its gradient at sample j.
template <int D>
void add_ball_cost(double weight, const MovingBall<D>& ball, const PieceSamples<D>& samples, int j,
                   PenaltyRows<D>& rows) {
  const double inverse_ds2 = 1.0 / (ball.radius_m * ball.radius_m);
  const Eigen::Matrix<double, D, 1> apart = samples.position().row(j).transpose() - ball.centre;
  const double ratio = apart.squaredNorm() * inverse_ds2;
  const Cubic penalty = cubic(1.0 - ratio);
  if (penalty.value == 0.0) return;
  const double scale = weight * penalty.slope;
  rows.value[j] += weight * penalty.value;
  rows.by_position().row(j) -= (2.0 * scale * inverse_ds2) * apart;
  rows.by_time[j] +=
      2.0 * scale *
      (apart.dot(ball.velocity) * inverse_ds2 + ratio * ball.radius_rate / ball.radius_m);
}

}  // namespace mocha
