#include "trajectory/bernstein.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace mocha {
namespace {

template <int D, int C>
Eigen::Matrix<double, D, C> random_polynomial(int seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, D, C> values;
  for (auto& x : values.reshaped()) x = normal(random);
  return values;
}

template <int D, int C>
Eigen::Matrix<double, D, 1> at(const Eigen::Matrix<double, D, C>& control, double u) {
  return split(control, u).second.col(0);
}

TEST(Bernstein, HasTheValuesOfTheMonomials) {
  const auto monomial = random_polynomial<2, 6>(1);
  const auto control = to_bernstein(monomial);
  for (double u = 0.0; u <= 1.0; u += 0.125) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int k = 5; k >= 0; --k) sum = sum * u + monomial.col(k);
    EXPECT_LT((at(control, u) - sum).norm(), 1e-12);
  }
}

TEST(Bernstein, SplitsDerivesAndMultiplies) {
  const auto a = random_polynomial<2, 5>(2);
  const auto b = random_polynomial<2, 4>(3);
  const auto parts = split(a, 0.3);
  const auto slope = derivative(a);
  for (double u = 0.0; u <= 1.0; u += 0.1) {
    EXPECT_LT((at(parts.first, u) - at(a, 0.3 * u)).norm(), 1e-12);
    EXPECT_LT((at(parts.second, u) - at(a, 0.3 + 0.7 * u)).norm(), 1e-12);
    EXPECT_NEAR(at(squared_norm(a), u)[0], at(a, u).squaredNorm(), 1e-12);
    const Eigen::Vector2d x = at(a, u);
    const Eigen::Vector2d y = at(b, u);
    EXPECT_NEAR(at(cross(a, b), u)[0], x.x() * y.y() - x.y() * y.x(), 1e-12);
    const double h = 1e-5;
    EXPECT_LT((at(slope, u) - (at(a, u + h) - at(a, u - h)) / (2 * h)).norm(), 1e-8);
  }
}

TEST(Bernstein, ElevatesAndDividesByZeros) {
  const auto a = random_polynomial<1, 4>(4);
  auto b = random_polynomial<2, 5>(5);
  b.col(0).setZero();
  for (double u = 0.1; u <= 1.0; u += 0.1) {
    EXPECT_NEAR(at(elevate<3>(a), u)[0], at(a, u)[0], 1e-12);
    EXPECT_LT((at(divided_at_start(b), u) - at(b, u) / u).norm(), 1e-12);
  }
}

TEST(Bernstein, CrossesInThreeDimensions) {
  const auto a = random_polynomial<3, 4>(6);
  const auto b = random_polynomial<3, 6>(7);
  for (double u = 0.0; u <= 1.0; u += 0.1) {
    EXPECT_LT((at(cross(a, b), u) - Eigen::Vector3d(at(a, u)).cross(at(b, u))).norm(), 1e-12);
  }
}

TEST(Bernstein, FindsTheFirstPositiveValue) {
  // (u - 0.25)(u - 0.6)(u - 0.7) is positive between the first two zeros and after the third.
  Eigen::Matrix<double, 1, 4> monomial;
  monomial << -0.25 * 0.6 * 0.7, 0.25 * 0.6 + 0.25 * 0.7 + 0.6 * 0.7, -1.55, 1.0;
  const Bernstein<1, 3> control = to_bernstein(monomial);
  EXPECT_NEAR(first_positive(control).value(), 0.25, 1e-6);
  EXPECT_EQ(first_positive(Bernstein<1, 3>(-control)).value(), 0.0);
  EXPECT_NEAR(first_positive(split(control, 0.3).second).value(), 0.0, 1e-6);
  EXPECT_NEAR(0.61 + 0.39 * first_positive(split(control, 0.61).second).value(), 0.7, 1e-6);
}

TEST(Bernstein, ProvesAbsenceNarrowly) {
  // -(u - 1/3)^2 - gap: control points of the whole are positive, its values are not.
  Eigen::Matrix<double, 1, 3> monomial;
  monomial << -1.0 / 9.0 - 1e-9, 2.0 / 3.0, -1.0;
  const Bernstein<1, 2> control = to_bernstein(monomial);
  EXPECT_GT(control.maxCoeff(), 0.0);
  EXPECT_FALSE(first_positive(control));
  monomial[0] += 2e-9;  // now just above zero near 1/3
  EXPECT_NEAR(first_positive(to_bernstein(monomial)).value(), 1.0 / 3.0, 1e-4);
}

TEST(Bernstein, NotANumberIsNoProof) {
  Bernstein<1, 3> control = Bernstein<1, 3>::Constant(-1.0);
  control[2] = std::nan("");
  EXPECT_TRUE(first_positive(control));
}

}  // namespace
}  // namespace mocha
