#pragma once

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// The largest value of something along a curve, and where it is taken.
struct Extremum {
  double value;   ///< never too small, and at most a share of 1e-9 too large
  double time_s;  ///< from the start of the curve
};

/// Speed [m/s], over the whole curve in continuous time: branch and bound on Bernstein hulls of the
/// squared norm.
template <int D, int S>
Extremum max_speed(const PiecewisePolynomial<D, S>& curve);

/// Acceleration [m/s^2] by its norm, likewise.
template <int D, int S>
Extremum max_acceleration(const PiecewisePolynomial<D, S>& curve);

/// The smallest factor >= 1 by which a curve has to be stretched() in time so that it keeps both
/// limits. Boundary velocities shrink with it, so it is meant for curves from rest to rest.
template <int D, int S>
double stretch_within(const PiecewisePolynomial<D, S>& curve, double max_speed_mps,
                      double max_acceleration_mps2);

}  // namespace mocha
