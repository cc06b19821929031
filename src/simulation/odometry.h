#pragma once

#include <cstdint>
#include <random>

#include "simulation/sensor_fault.h"
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

  /// Takes what was driven, and how it moves now.
  void add(const Arc& arc, const Twist& twist);

  /// How it lies from now on.
  void set_fault(const OdometryFault& fault);

  /// What it reports.
  const Pose& pose() const { return pose_; }
  const Twist& twist() const { return twist_; }

  /// What it would report, had it not begun to lie; where it has stopped lying, what it reports.
  const Pose& honest_pose() const { return honest_pose_; }

 private:
  double noise_distance_;
  double noise_yaw_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  OdometryFault fault_;
  Pose pose_;
  Twist twist_;
  Pose honest_pose_;
};

}  // namespace mocha
