#include "trajectory/arc_length.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "trajectory/minco_problem.h"

namespace mocha {
namespace {

template <typename Case>
class ArcLengthTest : public ::testing::Test {};
TYPED_TEST_SUITE(ArcLengthTest, test::AllCases);

/// The midpoint rule with many steps.
template <int D, int S>
double dense_length(const PiecewisePolynomial<D, S>& curve, double t0, double t1) {
  constexpr int kSteps = 200000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    sum += curve.derivative(t0 + (t1 - t0) * (i + 0.5) / kSteps, 1).norm();
  }
  return sum * (t1 - t0) / kSteps;
}

TYPED_TEST(ArcLengthTest, AgreesWithDenseSampling) {
  for (const int pieces : {1, 4, 7}) {
    const auto curve = test::Problem<TypeParam::D, TypeParam::S>(pieces, pieces).solved().curve();
    const double end = curve.duration();
    EXPECT_NEAR(arc_length(curve) / dense_length(curve, 0.0, end), 1.0, 1e-8);
    const double t0 = 0.21 * end;
    const double t1 = 0.64 * end;
    EXPECT_NEAR(arc_length(curve, t0, t1) / dense_length(curve, t0, t1), 1.0, 1e-8);
  }
}

TYPED_TEST(ArcLengthTest, KeepsItsToleranceAndAddsUp) {
  const auto curve = test::Problem<TypeParam::D, TypeParam::S>(9, 4).solved().curve();
  const double exact = arc_length(curve, 1e-12);
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-9}) {
    EXPECT_NEAR(arc_length(curve, tolerance) / exact, 1.0, tolerance);
  }
  double sum = 0.0;
  double t = -1.0;  // clamped
  for (; t < curve.duration(); t += 0.77) sum += arc_length(curve, t, t + 0.77);
  EXPECT_NEAR(sum / exact, 1.0, 1e-9);
  EXPECT_EQ(arc_length(curve, 1.0, 1.0), 0.0);
  EXPECT_NEAR(arc_length(curve, curve.duration(), 1e9), 0.0, 1e-12);
}

PlanarPath path_of(std::initializer_list<double> x, std::initializer_list<double> y, double tau) {
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  std::copy(x.begin(), x.end(), piece.row(0).begin());
  std::copy(y.begin(), y.end(), piece.row(1).begin());
  return PlanarPath({piece}, {tau});
}

TEST(ArcLength, IsKnownForSimpleCurves) {
  EXPECT_NEAR(arc_length(path_of({1, 0, 0, 30, -45, 18}, {2, 0, 0, 40, -60, 24}, 4.0)), 5.0, 5e-9);
  // The parabola (s, s^2) for s in [-1, 1].
  EXPECT_NEAR(arc_length(path_of({-1, 2}, {1, -4, 4}, 3.0)), std::sqrt(5.0) + 0.5 * std::asinh(2.0),
              3e-9);
  EXPECT_EQ(arc_length(path_of({1}, {2}, 1.0)), 0.0);
  EXPECT_EQ(arc_length(PlanarPath()), 0.0);
}

TEST(ArcLength, CountsTheWayThereAndBack) {
  // (s^2, 0) with s = u - 0.3: the speed has a kink.
  const PlanarPath turn = path_of({0.09, -0.6, 1}, {0}, 5.0);
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    EXPECT_NEAR(arc_length(turn, tolerance) / 0.58, 1.0, tolerance);
  }
  // The cusp (s^2, s^3).
  const PlanarPath cusp = path_of({0.09, -0.6, 1}, {-0.027, 0.27, -0.9, 1}, 1.0);
  const auto branch = [](double s) { return (std::pow(4.0 + 9.0 * s * s, 1.5) - 8.0) / 27.0; };
  EXPECT_NEAR(arc_length(cusp, 1e-12) / (branch(0.3) + branch(0.7)), 1.0, 1e-11);
}

TEST(ArcLength, SeesAStopBetweenFastPieces) {
  // Between two long fast pieces a short way there and back.
  const PlanarPath fast = path_of({0, 1000}, {0}, 1.0);
  const PlanarPath turn = path_of({0.25e-3, -1e-3, 1e-3}, {0}, 10.0);
  const PlanarPath all({fast.piece(0), turn.piece(0), fast.piece(0)}, {1.0, 10.0, 1.0});
  EXPECT_NEAR(arc_length(all, 1e-12), 2000.0005, 4e-9);
}

TEST(ArcLength, RefusesBadArguments) {
  const PlanarPath path = path_of({0, 1}, {0}, 1.0);
  const double nan = std::nan("");
  EXPECT_THROW(arc_length(path, 1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(arc_length(path, nan, 1.0), std::invalid_argument);
  EXPECT_THROW(arc_length(path, 0.0, nan), std::invalid_argument);
  for (const double tolerance : {0.0, -1.0, 1e-13, 0.2, nan}) {
    EXPECT_THROW(arc_length(path, tolerance), std::invalid_argument);
  }
}

}  // namespace
}  // namespace mocha
