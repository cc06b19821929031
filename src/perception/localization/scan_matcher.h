#pragma once

#include <Eigen/Core>
#include <string>

#include "perception/localization/likelihood_field.h"
#include "perception/sensor/scan_hits.h"

namespace mocha {

/// Where a robot is, and how well that is known.
struct PoseEstimate {
  Pose pose;  ///< map frame
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< of (x [m], y [m], yaw [rad]), map frame

  /// Standard deviations.
  double sigma_m() const;
  double sigma_rad() const;
};

/// What is wrong with an estimate, in a few words that do not depend on its numbers; empty for one
/// that can be matched.
std::string fault_of(const PoseEstimate& estimate);

struct ScanMatcherOptions {
  double hit_noise_m;    ///< standard deviation of a hit across its wall, map's error included
  double hit_reach_m;    ///< hits much farther from any wall than this have no say
  int independent_hits;  ///< more hits than these add no certainty: their errors are alike
};

/// Fits a scan to the walls of a map, beginning from what is known of the pose: nonlinear least
/// squares over the hits' distances to the walls and the pose's to its prior.
class ScanMatcher {
 public:
  explicit ScanMatcher(const ScanMatcherOptions& options) : options_(options) {}

  /// The prior must be without fault.
  PoseEstimate match(const ScanHits& scan, const LikelihoodField& walls,
                     const PoseEstimate& prior) const;

 private:
  ScanMatcherOptions options_;
};

}  // namespace mocha
