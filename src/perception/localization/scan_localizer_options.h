#pragma once

#include <cstddef>

#include "config/parameter_table.h"
#include "perception/localization/odometry_noise.h"
#include "perception/localization/place_hypotheses.h"
#include "perception/localization/scan_matcher.h"
#include "world/robot_model.h"

namespace mocha {

struct ScanLocalizerOptions {
  ScanMatcherOptions matcher;
  double wall_depth_m;  ///< middle of a mapped wall behind its surface
  std::size_t hits;     ///< of a scan, at most
  double tolerance_m;   ///< a hit that near to a wall of the map is explained by it
  int least_hits;       ///< explained or not; fewer say nothing about the place
  PlaceHypotheses::Options places;
  double trial_s;            ///< for so long a place is tried before it is believed
  double search_interval_s;  ///< between wide searches
  int search_budget;         ///< see BranchAndBoundMatcher
  double max_sigma_m;        ///< a robot whose place is less sure is lost
  double max_sigma_yaw_rad;  ///< the same for its heading
  double max_speed;          ///< [m/s] no robot is faster
  OdometryNoise odometry;

  /// From the parameters of the same names, without units; the odometry's noise is the model's.
  static ScanLocalizerOptions from(const ParameterTable& values, const RobotModel& model);
};

}  // namespace mocha
