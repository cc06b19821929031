#pragma once

#include <cstdint>
#include <random>

#include "trajectory/motion.h"

namespace mocha {

/// What a small rover whose wheels skid would believe that it has driven: it measures distances and
/// turns by factors of its own (3 % and 5 %, standard deviation) wrong, swerves (0.6 degrees a
/// metre), scatters from step to step, and once in a hundred steps its wheels slip. Made up, as the
/// lidar logs hold no odometry.
class SkidOdometry {
 public:
  explicit SkidOdometry(std::uint64_t seed);

  /// Takes the true motion since the step before, as seen from there. Returns the pose that the
  /// odometry reports.
  const Pose& add(const Pose& step);

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double distance_factor_;
  double turn_factor_;
  double swerve_rad_per_m_;
  Pose pose_;
};

}  // namespace mocha
