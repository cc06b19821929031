#pragma once

#include <Eigen/Core>

namespace mocha {

/// Variance of what a plane does not tell: height, roll, pitch.
constexpr double kUnknownVariance = 1e6;
/// Where x, y and yaw stand among x, y, z and the rotations about them.
constexpr int kPlanarAxes[] = {0, 1, 5};

/// Fills the 6 by 6 covariance of a message from that of x, y and yaw.
template <typename Covariance>
void put_covariance(const Eigen::Matrix3d& planar, Covariance& covariance) {
  covariance.fill(0.0);
  for (const int other : {2, 3, 4}) covariance[7 * other] = kUnknownVariance;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      covariance[6 * kPlanarAxes[row] + kPlanarAxes[column]] = planar(row, column);
  }
}

/// The part of x, y and yaw.
template <typename Covariance>
Eigen::Matrix3d planar_covariance(const Covariance& covariance) {
  Eigen::Matrix3d planar;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      planar(row, column) = covariance[6 * kPlanarAxes[row] + kPlanarAxes[column]];
  }
  return planar;
}

}  // namespace mocha
