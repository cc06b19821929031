#pragma once

#include <cstdint>
#include <istream>
#include <vector>

#include "benchmarks/carmen_log.h"
#include "perception/sensor/scan_hits.h"

namespace mocha {

/// A scan of a lidar log as the robot that took it would hand it on; the lidar is in its middle.
struct LogScan {
  ScanHits scan;
  Pose odometry;  ///< made up, see SkidOdometry
  Pose truth;     ///< the log's corrected pose
};

/// The log as a drive at the pace of a small rover. Of hits closer together than `spacing_m` one is
/// kept; beams that end beyond 30 m met nothing.
std::vector<LogScan> drive_of(const std::vector<LoggedScan>& log, std::uint64_t seed,
                              double spacing_m);

}  // namespace mocha
