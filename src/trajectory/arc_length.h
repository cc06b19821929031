#pragma once

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

// Lengths by Gauss-Legendre quadrature with adaptive halving. `relative_tolerance` is that of the
// result and must lie in [1e-12, 0.1]; std::invalid_argument is thrown otherwise.

/// Length of the path [m].
template <int D, int S>
double arc_length(const PiecewisePolynomial<D, S>& curve, double relative_tolerance = 1e-9);

/// Length of the part from t0 to t1 [s], which are clamped into [0, curve.duration()]. Throws
/// std::invalid_argument unless t0 <= t1.
template <int D, int S>
double arc_length(const PiecewisePolynomial<D, S>& curve, double t0, double t1,
                  double relative_tolerance = 1e-9);

}  // namespace mocha
