#pragma once

#include <vector>

#include "perception/sensor/beam.h"
#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// A wall that reaches into what a lidar does not see, and is taken to go on there: straight.
struct BlindWall {
  Vector2 end;     ///< the last that was seen of it, map frame [m]
  Vector2 along;   ///< unit; where it goes on
  Vector2 behind;  ///< unit, across; away from the lidar

  /// Whether a place is in it or behind it; false beside what was seen.
  bool hides(const Vector2& place) const {
    return (place - end).dot(along) >= 0.0 && (place - end).dot(behind) >= 0.0;
  }
};

/// The walls at the two ends of a planar sweep, up to two. A wall is 10 cm of straight surface at
/// least, and goes on as up to 30 cm of it lie.
std::vector<BlindWall> blind_walls(const std::vector<Beam>& sweep);

}  // namespace mocha
