#include "trajectory/piece_hull.h"

#include <gtest/gtest.h>

#include <random>

#include "trajectory/minco_problem.h"

namespace mocha {
namespace {

template <typename Case>
class PieceHullTest : public ::testing::Test {};
TYPED_TEST_SUITE(PieceHullTest, test::AllCases);

/// Inside a convex hull is what no direction tells apart from it.
template <int D, int C>
void expect_inside(const Eigen::Matrix<double, D, C>& hull,
                   const Eigen::Matrix<double, D, 1>& point) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const double slack = 1e-12 * hull.cwiseAbs().maxCoeff();
  for (int i = 0; i < 100; ++i) {
    Eigen::Matrix<double, D, 1> direction;
    for (auto& x : direction) x = normal(random);
    EXPECT_GE((direction.transpose() * hull).maxCoeff(), direction.dot(point) - 10.0 * slack);
  }
}

TYPED_TEST(PieceHullTest, HoldsTheCurveAndItsDerivatives) {
  constexpr int kPieces = 5;
  const auto curve = test::Problem<TypeParam::D, TypeParam::S>(kPieces, 3).solved().curve();
  for (int i = 0; i < kPieces; ++i) {
    const auto hull = piece_hull(curve.piece(i), curve.piece_duration(i));
    for (double u = 0.0; u <= 1.0; u += 0.01) {
      expect_inside(hull.position, curve.derivative({i, u}, 0));
      expect_inside(hull.velocity, curve.derivative({i, u}, 1));
      expect_inside(hull.acceleration, curve.derivative({i, u}, 2));
    }
  }
}

TYPED_TEST(PieceHullTest, HasTheCurvesEndsAndBernsteinForm) {
  constexpr int kPieces = 5;
  const auto curve = test::Problem<TypeParam::D, TypeParam::S>(kPieces, 4).solved().curve();
  for (int i = 0; i < kPieces; ++i) {
    const double tau = curve.piece_duration(i);
    const auto hull = piece_hull(curve.piece(i), tau);
    const auto expect_ends = [&](const auto& control, int order) {
      const auto size = 1e-12 * control.norm();
      EXPECT_LE((control.col(0) - curve.derivative({i, 0.0}, order)).norm(), size);
      EXPECT_LE((control.col(control.cols() - 1) - curve.derivative({i, 1.0}, order)).norm(), size);
    };
    expect_ends(hull.position, 0);
    expect_ends(hull.velocity, 1);
    expect_ends(hull.acceleration, 2);
    const auto position = to_bernstein(curve.piece(i));
    const auto velocity = derivative(position);
    EXPECT_TRUE(hull.position.isApprox(position, 1e-12));
    EXPECT_TRUE(hull.velocity.isApprox(velocity / tau, 1e-12));
    EXPECT_TRUE(hull.acceleration.isApprox(derivative(velocity) / (tau * tau), 1e-12));
  }
}

TEST(PieceHull, LosesNothingFarFromTheOrigin) {
  const auto curve = test::Problem<2, 3>(1, 5).solved().curve();
  PlanarPath::Piece far = curve.piece(0);
  far.col(0) += Vector2(1e9, -1e9);
  const double tau = curve.piece_duration(0);
  EXPECT_EQ(piece_hull(far, tau).velocity, piece_hull(curve.piece(0), tau).velocity);
  EXPECT_EQ(piece_hull(far, tau).acceleration, piece_hull(curve.piece(0), tau).acceleration);
}

}  // namespace
}  // namespace mocha
