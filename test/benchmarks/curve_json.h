#pragma once

#include <cmath>
#include <cstdio>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// A further member of a JSON object: a list with one list a column.
inline void print_columns(const char* key, const Eigen::MatrixXd& columns) {
  std::printf(",\n\"%s\": [", key);
  for (int i = 0; i < columns.cols(); ++i) {
    std::printf("%s[", i == 0 ? "" : ", ");
    for (int k = 0; k < columns.rows(); ++k) {
      std::printf("%s%.6g", k == 0 ? "" : ", ", columns(k, i));
    }
    std::printf("]");
  }
  std::printf("]");
}

/// Time [s], position [m], speed [m/s] and acceleration [m/s^2], at uniform time.
template <int D>
Eigen::MatrixXd samples(const PiecewisePolynomial<D, 3>& curve) {
  constexpr double kStep_s = 0.02;
  const int steps = static_cast<int>(std::ceil(curve.duration() / kStep_s));
  Eigen::MatrixXd columns(3 + D, steps + 1);
  for (int i = 0; i <= steps; ++i) {
    const double t = curve.duration() * i / steps;
    const auto state = curve.state(t);
    columns.col(i) << t, state.col(0), state.col(1).norm(), state.col(2).norm();
  }
  return columns;
}

}  // namespace mocha
