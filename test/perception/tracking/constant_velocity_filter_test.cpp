#include "perception/tracking/constant_velocity_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <random>

namespace mocha {
namespace {

Eigen::Matrix2d square(double sigma_m) { return sigma_m * sigma_m * Eigen::Matrix2d::Identity(); }

TEST(ConstantVelocityFilter, KnowsHowFarItIsOff) {
  constexpr double kSigma_m = 0.08;
  constexpr double kDensity = 0.5;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  int samples = 0;
  for (int run = 0; run < 400; ++run) {
    Eigen::Vector4d truth(0.0, 0.0, 1.0 * normal(random), 1.0 * normal(random));
    const auto measured = [&] {
      return Vector2(truth.head<2>() + kSigma_m * Vector2(normal(random), normal(random)));
    };
    ConstantVelocityFilter filter(0.0, measured(), square(kSigma_m), 1.0);
    for (int scan = 1; scan <= 30; ++scan) {
      constexpr int kSubsteps = 20;
      constexpr double kStep_s = 0.1 / kSubsteps;
      for (int i = 0; i < kSubsteps; ++i) {
        truth.head<2>() += kStep_s * truth.tail<2>();
        truth.tail<2>() += std::sqrt(kDensity * kStep_s) * Vector2(normal(random), normal(random));
      }
      filter.predict(0.1 * scan, kDensity);
      filter.update(measured(), square(kSigma_m));
      Eigen::Vector4d error;
      error << filter.position() - truth.head<2>(), filter.velocity() - truth.tail<2>();
      sum += error.dot(filter.covariance().ldlt().solve(error));
      ++samples;
    }
  }
  EXPECT_NEAR(sum / samples, 4.0, 0.3);
}

TEST(ConstantVelocityFilter, GoesBackAndForthButNeverGetsSurer) {
  ConstantVelocityFilter filter(0.0, {1.0, 2.0}, square(0.1), 1.0);
  filter.predict(0.1, 1.0);
  filter.update({1.1, 2.0}, square(0.1));
  const ConstantVelocityFilter before = filter;
  filter.predict(0.05, 1.0);
  EXPECT_LT((filter.position() - before.position() + 0.05 * before.velocity()).norm(), 1e-12);
  filter.predict(0.1, 1.0);
  EXPECT_LT((filter.position() - before.position()).norm(), 1e-12);
  EXPECT_GT((filter.covariance() - before.covariance()).eigenvalues().real().minCoeff(), -1e-12);
}

TEST(ConstantVelocityFilter, MismatchIsMeasuredInDeviations) {
  const ConstantVelocityFilter filter(0.0, {0.0, 0.0}, square(0.3), 1.0);
  // sqrt(0.3^2 + 0.4^2) = 0.5
  EXPECT_NEAR(filter.mismatch({1.0, 0.0}, square(0.4)).squared, 4.0, 1e-12);
  EXPECT_NEAR(filter.mismatch({1.0, 0.0}, square(0.4)).log_determinant, std::log(0.25 * 0.25),
              1e-12);
}

}  // namespace
}  // namespace mocha
