#pragma once

#include <istream>
#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// A sweep of a planar lidar, and where it stood.
struct LoggedScan {
  Pose laser;
  std::vector<double> ranges_m;  ///< evenly from -90 degrees on; what met nothing is very far

  /// Of a beam, from the laser.
  double angle_rad(std::size_t beam) const;
  /// Seen from the laser.
  Vector2 hit(std::size_t beam) const;
};

/// The FLASER lines of a lidar log in CARMEN's format: with 180 or 181 beams they are one degree
/// apart, with 360 or 361 half a degree. Throws std::invalid_argument where there are none.
std::vector<LoggedScan> read_carmen_log(std::istream& log);

}  // namespace mocha
