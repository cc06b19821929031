#pragma once

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// Position [m] and heading [rad] in the map frame.
struct Pose {
  Vector2 position = Vector2::Zero();
  double yaw_rad = 0.0;
};

/// Wraps into (-pi, pi].
double wrap_angle(double angle_rad);

}  // namespace mocha
