#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "perception/localization/scan_matcher.h"

namespace mocha {

/// What ScanMatcher makes small, in the form that ceres::TinySolver takes: a residual for each hit,
/// then three for the prior. The unknowns are (x [m], y [m], yaw [rad]) less the prior's; all
/// residuals are in standard deviations.
class MatchFunction {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 3 };

  MatchFunction(const ScanHits& scan, const LikelihoodField& walls, const PoseEstimate& prior,
                const ScanMatcherOptions& options)
      : scan_(scan), walls_(walls), prior_(prior.pose), reach_m_(options.hit_reach_m) {
    const double alike =
        std::max(1.0, static_cast<double>(scan.hits.size()) / options.independent_hits);
    hit_weight_ = 1.0 / (options.hit_noise_m * std::sqrt(alike));
    prior_root_ = prior.covariance.inverse().llt().matrixU();
  }

  int NumResiduals() const { return static_cast<int>(scan_.hits.size()) + 3; }

  /// `jacobian` is column-major, NumResiduals() by 3, or null. Always true.
  bool operator()(const double* change, double* residuals, double* jacobian) const {
    const Eigen::Vector3d by(change[0], change[1], change[2]);
    const double cosine = std::cos(prior_.yaw_rad + by.z());
    const double sine = std::sin(prior_.yaw_rad + by.z());
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3>> slopes(jacobian, NumResiduals(), 3);
    int row = 0;
    for (const Vector2& hit : scan_.hits) {
      const Vector2 turned(cosine * hit.x() - sine * hit.y(), sine * hit.x() + cosine * hit.y());
      const auto wall = walls_.sample(prior_.position + by.head<2>() + turned);
      // Grows like the distance at first and ends at the reach: what is far from every wall is
      // nothing that the map knows.
      const double ratio = wall.distance_m / reach_m_;
      const double damping = 1.0 / std::sqrt(1.0 + ratio * ratio);
      residuals[row] = hit_weight_ * wall.distance_m * damping;
      if (jacobian != nullptr) {
        const Vector2 slope = hit_weight_ * damping * damping * damping * wall.gradient;
        slopes.row(row) << slope.x(), slope.y(), slope.dot(Vector2(-turned.y(), turned.x()));
      }
      ++row;
    }
    Eigen::Map<Eigen::Vector3d>(residuals + row) = prior_root_ * by;
    if (jacobian != nullptr) slopes.bottomRows<3>() = prior_root_;
    return true;
  }

 private:
  const ScanHits& scan_;
  const LikelihoodField& walls_;
  Pose prior_;
  double reach_m_;
  double hit_weight_;
  Eigen::Matrix3d prior_root_;
};

}  // namespace mocha
