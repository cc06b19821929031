#pragma once

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// Length [m] of a curve, to a share of about 1e-9.
template <int D, int S>
double arc_length(const PiecewisePolynomial<D, S>& curve);

}  // namespace mocha
