#pragma once

#include <cstdint>
#include <random>

#include "simulation/vehicle.h"

namespace mocha {

/// What a robot believes that it has driven: the true arcs plus a random walk, whose variance grows
/// with distance and turning (slip that the wheels do not see). Starts at the origin of its own
/// frame.
class Odometry {
 public:
  /// Standard deviations: along the path per square root of a metre, of the heading per square root
  /// of a radian.
  Odometry(double noise_distance, double noise_yaw, std::uint64_t seed);

  void add(const Arc& arc);
  const Pose& pose() const { return pose_; }

 private:
  double noise_distance_;
  double noise_yaw_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose pose_;
};

}  // namespace mocha
