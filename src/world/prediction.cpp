#include "world/prediction.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

constexpr double kRounding = 1e-6;  // of a filter's arithmetic, relative

void require_covariance(const Eigen::Matrix4d& covariance) {
  const double largest = covariance.cwiseAbs().maxCoeff();
  const bool sound =
      covariance.allFinite() &&
      (covariance - covariance.transpose()).cwiseAbs().maxCoeff() <= kRounding * largest &&
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(covariance, Eigen::EigenvaluesOnly)
              .eigenvalues()[0] >= -kRounding * largest;
  if (!sound) {
    throw std::invalid_argument(
        "the covariance is not finite, not symmetric, or not positive semidefinite");
  }
}

/// The largest standard deviation of a planar quantity.
double largest_sigma(const Eigen::Matrix2d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, axes.eigenvalues()[1]));
}

}  // namespace

RadiusGrowth growth_of(const Eigen::Matrix4d& covariance, double confidence) {
  if (!(confidence >= 0.0 && confidence <= 0.9999)) {
    throw std::invalid_argument("confidence = " + std::to_string(confidence) + ", 0 to 0.9999");
  }
  require_covariance(covariance);
  // Of a planar normal distribution, the share exp(-k^2 / 2) is more than k deviations away.
  const double deviations = std::sqrt(-2.0 * std::log(1.0 - confidence));
  return {deviations * largest_sigma(covariance.topLeftCorner<2, 2>()),
          deviations * largest_sigma(covariance.bottomRightCorner<2, 2>())};
}

}  // namespace mocha
