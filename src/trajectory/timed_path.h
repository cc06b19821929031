#pragma once

#include <vector>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

struct TimedPoint {
  Vector2 position;
  double time_s;  ///< absolute
};

/// Where something is when: straight and uniform between points, whose times increase.
using TimedPath = std::vector<TimedPoint>;

/// The place at a time, which is clamped to those of the path. The path must not be empty.
Vector2 position_at(const TimedPath& path, double time_s);

}  // namespace mocha
