#pragma once

#include <Eigen/Core>
#include <cmath>

namespace mocha {

/// |a| |b| times the sine of the angle from a to b: positive where b points to the left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// From a to b, counter-clockwise, between -pi and pi [rad]; 0 where one of them is zero.
inline double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

}  // namespace mocha
