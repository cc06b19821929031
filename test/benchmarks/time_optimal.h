#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// The least time [s] in which the path of a curve can be driven from rest to rest within limits of
/// speed and acceleration (by its norm, along and across together): one pass forward and one
/// backward over fine steps.
template <int D, int S>
double time_optimal_s(const PiecewisePolynomial<D, S>& curve, double max_speed,
                      double max_acceleration) {
  constexpr int kSteps = 20000;
  constexpr double kSlow = 0.3;  // [m/s] below, the curvature is that of rounding at rest
  std::vector<double> step_m(kSteps + 1, 0.0);
  std::vector<double> curvature(kSteps + 1, 0.0);
  std::vector<double> speed(kSteps + 1, max_speed);
  for (int i = 0; i <= kSteps; ++i) {
    const double t = curve.duration() * i / kSteps;
    const auto v = curve.derivative(t, 1);
    const auto a = curve.derivative(t, 2);
    const double v2 = v.squaredNorm();
    if (i > 0)
      step_m[i] = (curve.position(t) - curve.position(t - curve.duration() / kSteps)).norm();
    if (v2 > kSlow * kSlow) curvature[i] = (a * v2 - v * v.dot(a)).norm() / (v2 * v2);
    speed[i] = std::min(max_speed, std::sqrt(max_acceleration / (curvature[i] + 1e-9)));
  }
  const auto limit_gain = [&](int to, int from, double step) {
    const double across = curvature[from] * speed[from] * speed[from];
    const double along =
        std::sqrt(std::max(0.0, max_acceleration * max_acceleration - across * across));
    speed[to] = std::min(speed[to], std::sqrt(speed[from] * speed[from] + 2.0 * along * step));
  };
  speed.front() = speed.back() = 0.0;
  for (int i = 1; i <= kSteps; ++i) limit_gain(i, i - 1, step_m[i]);
  for (int i = kSteps; i > 0; --i) limit_gain(i - 1, i, step_m[i]);
  double total_s = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double sum = speed[i] + speed[i - 1];
    if (sum > 0.0) total_s += 2.0 * step_m[i] / sum;
  }
  return total_s;
}

}  // namespace mocha
