#pragma once

#include <memory>
#include <vector>

#include "perception/localization/scan_matcher.h"
#include "perception/pose_graph/keyframe.h"

namespace mocha {

/// Squared errors of a pose, in variances of a hit, as a function of its changes (x [m], y [m],
/// yaw [rad]): half of change' * information * change + gradient' * change.
struct QuadraticError {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// What the surfels of one keyframe say of the pose of an aligned scan.
struct Agreement {
  int keyframe = 0;
  int surfels = 0;  ///< of the scan, that lie on its walls
  QuadraticError error;
};

/// Where a scan lies among walls.
struct Alignment {
  Pose pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< with what was known before
  double explained = 0.0;  ///< share of the scan's surfels that lie on walls
  std::vector<Agreement> agreements;
};

/// The walls that some keyframes saw, to align scans with. Walls that are seen from both sides are
/// two.
class SurfelMap {
 public:
  explicit SurfelMap(const std::vector<PlacedKeyframe>& keyframes);
  ~SurfelMap();

  /// Point to line, by Gauss-Newton steps that begin at the prior and pair surfels at most
  /// `reach_m` apart, less in the end. The prior must be without fault.
  Alignment align(const std::vector<Surfel>& scan, const PoseEstimate& prior, double reach_m) const;

 private:
  struct Index;
  struct Pair;

  std::vector<Pair> pairs(const std::vector<Surfel>& scan, const Pose& pose, double reach_m) const;

  std::unique_ptr<Index> index_;
};

}  // namespace mocha
