#pragma once

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// A largest value over a whole curve. `value` is an upper bound, at most 1e-9 (relative) above the
/// true maximum; `time_s` [s] is a time at which the curve comes that close to it.
struct Extremum {
  double value;
  double time_s;
};

// Branch and bound on control points, which never misses a peak between samples. All throw
// std::invalid_argument for a curve without pieces or with coefficients that are not finite.

/// The largest |v| [m/s].
template <int D, int S>
Extremum max_speed(const PiecewisePolynomial<D, S>& curve);

/// The largest |a| [m/s^2]. At a knot where it jumps, both sides count.
template <int D, int S>
Extremum max_acceleration(const PiecewisePolynomial<D, S>& curve);

/// The largest curvature |v x a| / |v|^3 [1/m] of the path. It is at rest where |v| is below 1e-9
/// of the piece's largest velocity control point:
/// - Where it begins or ends at rest, the limit of the curvature counts. Let k be the order of the
///   velocity's zero: 1 if the curve departs with acceleration, 2 if with jerk only, and so on. The
///   limit is finite if the next k derivatives lie along the direction of departure (to 1e-9), as
///   on a straight line. Otherwise the path bends ever more sharply towards the rest, and the
///   result is infinity.
/// - A rest anywhere else gives infinity, be it a cusp, a reversal or a pause on a straight line;
/// so
///   does a piece that stands still.
template <int D, int S>
Extremum max_curvature(const PiecewisePolynomial<D, S>& curve);

}  // namespace mocha
