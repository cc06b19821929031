#pragma once

#include <optional>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

struct StretchLimits {
  double speed;           ///< [m/s], above 0
  double acceleration;    ///< [m/s^2], above 0
  double largest_factor;  ///< of the duration, at least 1
};

/// The smallest factor >= 1 by which curve.stretched() brings the curve within both limits (to
/// 1e-9, relative), everywhere; nothing if the largest factor does not suffice.
///
/// Stretching slows down everything, the boundary velocities too. So it is for curves from rest to
/// rest: where a stretch would be needed and the curve begins or ends faster than 1e-6 m/s, there
/// is nothing either. Boundary accelerations change as well.
///
/// Throws std::invalid_argument for limits out of range and for curves that max_speed() refuses.
template <int D, int S>
std::optional<double> smallest_stretch(const PiecewisePolynomial<D, S>& curve,
                                       const StretchLimits& limits);

}  // namespace mocha
