#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "perception/sensor/beam.h"

namespace mocha {

/// One sweep of a planar lidar, in its own frame: beam i looks along angle_min + i *
/// angle_increment in the x-y plane.
struct PlanarScan {
  double start_time_s = 0.0;      ///< of the first beam
  double time_increment_s = 0.0;  ///< between beams; 0: all at once
  double angle_min_rad = 0.0;
  double angle_max_rad = 0.0;
  double angle_increment_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;

  double end_time_s() const;  ///< of the last beam
};

/// What is wrong with a scan, in a few words that do not depend on its numbers; empty for a scan
/// that can be used.
std::string fault_of(const PlanarScan& scan);

/// How far beams count.
struct BeamReach {
  double hit_m;    ///< ends beyond are not obstacles; the beam then clears like one without return
  double clear_m;  ///< how far a beam without return clears
};

/// The sensor's pose in the map frame while it swept.
struct SweepPoses {
  Eigen::Isometry3d first;  ///< at the time of the first beam
  Eigen::Isometry3d last;   ///< at the time of the last beam
};

/// The pose between `first` (share 0) and `last` (share 1): straight line, shortest turn.
Eigen::Isometry3d interpolate(const SweepPoses& poses, double share);

/// The beams of a scan in the map frame, each from where the sensor was when it was measured.
/// Infinite ranges and those of range_max and more met nothing; NaN and ranges below range_min say
/// nothing and are left out.
std::vector<Beam> to_beams(const PlanarScan& scan, const SweepPoses& poses, const BeamReach& reach);

}  // namespace mocha
