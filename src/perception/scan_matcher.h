#pragma once

#include <Eigen/Core>

#include "perception/scan_hits.h"
#include "perception/wall_field.h"

namespace mocha {

/// Where a robot is, and how well that is known.
struct PoseEstimate {
  Pose pose;  ///< map frame
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< of (x [m], y [m], yaw [rad]), map frame
};

struct ScanMatcherOptions {
  double hit_noise_m = 0.04;  ///< standard deviation of a hit across its wall, map's error included
  double hit_reach_m = 0.15;  ///< hits much farther from any wall than this have no say
  int independent_hits = 30;  ///< more hits than these add no certainty: their errors are alike
};

/// Fits a scan to the walls of a map, beginning from what is known of the pose: nonlinear least
/// squares over the hits' distances to the walls and the pose's to its prior.
class ScanMatcher {
 public:
  explicit ScanMatcher(const ScanMatcherOptions& options) : options_(options) {}

  /// The prior's covariance must be positive definite.
  PoseEstimate match(const ScanHits& scan, const WallField& walls, const PoseEstimate& prior) const;

 private:
  ScanMatcherOptions options_;
};

}  // namespace mocha
