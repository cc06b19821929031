#pragma once

#include <array>
#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// The robot of Table II: a disc that moves freely in the plane.
struct Table2Robot {
  static constexpr double kRadius_m = 0.3;
  static constexpr double kMaxSpeed = 3.0;         ///< [m/s]
  static constexpr double kMaxAcceleration = 2.0;  ///< [m/s^2]
};

/// A seeded world of Table II: 50 circles of 1 to 4 m radius in 100 m x 100 m, at least 1 m apart
/// from each other, from the start in one corner and from the targets.
struct Table2World {
  static constexpr double kSide_m = 100.0;
  static constexpr double kBorder_m = 5.0;  ///< open ground around, also to be driven on

  std::vector<Circle> circles;
  Vector2 start;
  std::array<Vector2, 3> targets;  ///< paths of about 145, 115 and 93 m
};

Table2World table2_world(int seed);

}  // namespace mocha
