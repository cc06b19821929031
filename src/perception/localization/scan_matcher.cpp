#include "perception/localization/scan_matcher.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "perception/localization/match_function.h"

namespace mocha {
namespace {

constexpr int kMostSteps = 20;

}  // namespace

double PoseEstimate::sigma_m() const { return std::sqrt(covariance.topLeftCorner<2, 2>().trace()); }

double PoseEstimate::sigma_rad() const { return std::sqrt(covariance(2, 2)); }

std::string fault_of(const PoseEstimate& estimate) {
  if (!is_usable(estimate.pose.position) || !std::isfinite(estimate.pose.yaw_rad))
    return "not finite, or too far away";
  if (!estimate.covariance.allFinite() || estimate.covariance.llt().info() != Eigen::Success)
    return "its covariance is not positive definite";
  return {};
}

PoseEstimate ScanMatcher::match(const ScanHits& scan, const LikelihoodField& walls,
                                const PoseEstimate& prior) const {
  const MatchFunction function(scan, walls, prior, options_);
  ceres::TinySolver<MatchFunction> solver;
  solver.options.max_num_iterations = kMostSteps;
  Eigen::Vector3d change = Eigen::Vector3d::Zero();
  solver.Solve(function, &change);
  const int rows = function.NumResiduals();
  Eigen::VectorXd residuals(rows);
  Eigen::Matrix<double, Eigen::Dynamic, 3> jacobian(rows, 3);
  function(change.data(), residuals.data(), jacobian.data());
  return {{prior.pose.position + change.head<2>(), wrap_angle(prior.pose.yaw_rad + change.z())},
          (jacobian.transpose() * jacobian).inverse()};
}

}  // namespace mocha
