#pragma once

#include <vector>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// Somewhere at some time: map frame [m], absolute time [s].
struct TimedPoint {
  Vector2 position = Vector2::Zero();
  double time_s = 0.0;
};

/// Later and later; straight and uniform between the points.
using TimedPath = std::vector<TimedPoint>;

}  // namespace mocha
