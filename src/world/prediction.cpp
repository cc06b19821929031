#include "world/prediction.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

/// The largest standard deviation of a planar quantity.
double largest_sigma(const Eigen::Matrix2d& covariance, const char* of) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance, Eigen::EigenvaluesOnly);
  if (!covariance.allFinite() || !(axes.eigenvalues()[0] >= 0.0)) {
    throw std::invalid_argument(std::string("covariance of the ") + of +
                                " is not finite, or not positive semidefinite");
  }
  return std::sqrt(axes.eigenvalues()[1]);
}

}  // namespace

RadiusGrowth growth_of(const Eigen::Matrix4d& covariance, double confidence) {
  if (!(confidence >= 0.0 && confidence <= 0.9999)) {
    throw std::invalid_argument("confidence = " + std::to_string(confidence) + ", 0 to 0.9999");
  }
  // Of a planar normal distribution, the share exp(-k^2 / 2) is more than k deviations away.
  const double deviations = std::sqrt(-2.0 * std::log(1.0 - confidence));
  return {deviations * largest_sigma(covariance.topLeftCorner<2, 2>(), "place"),
          deviations * largest_sigma(covariance.bottomRightCorner<2, 2>(), "velocity")};
}

}  // namespace mocha
