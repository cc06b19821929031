#pragma once

#include <string>

#include "config/parameter_table.h"

namespace mocha {

/// How a lidar lies, with stamps as fresh as ever.
struct LidarFault {
  bool frozen = false;        ///< repeats its newest sweep
  double delay_s = 0.0;       ///< sweeps are older than they say
  double turn_rad = 0.0;      ///< it is mounted so much further to the left than is known
  double noise_factor = 1.0;  ///< on the standard deviation of its ranges
  double blind_rad = 0.0;     ///< width of the sector ahead of it whose beams return nothing
};

/// How an odometry lies, with stamps as fresh as ever.
struct OdometryFault {
  bool frozen = false;  ///< pose and twist stay as they are
  double slip = 0.0;    ///< share of the travel that the wheels turn beyond it
};

/// How the sensors of a robot lie.
struct SensorFault {
  static constexpr double kLongestDelay_s = 1.0;

  LidarFault lidar;
  OdometryFault odometry;

  /// The one that `sensor_fault` of config/fleet_simulator.yaml names, of the size that is given
  /// beside it.
  static SensorFault from(const ParameterTable& values);
};

}  // namespace mocha
