#include "trajectory/piecewise_polynomial.h"

#include <gtest/gtest.h>

#include "trajectory/minco_problem.h"
#include "trajectory/random_motion.h"

namespace mocha {
namespace {

TEST(PiecewisePolynomial, RefusesWhatIsNoCurve) {
  const PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  EXPECT_THROW(PlanarPath({}, {}), std::invalid_argument);
  EXPECT_THROW(PlanarPath({piece, piece}, {1.0}), std::invalid_argument);
  EXPECT_THROW(PlanarPath({piece}, {0.0}), std::invalid_argument);
  EXPECT_THROW(PlanarPath({piece}, {-1.0}), std::invalid_argument);
  EXPECT_THROW(PlanarPath({piece}, {std::nan("")}), std::invalid_argument);
  EXPECT_THROW(PlanarPath({piece}, {INFINITY}), std::invalid_argument);
}

TEST(PiecewisePolynomial, DerivativesAreThoseOfTheMonomials) {
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  piece.row(0) << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  const PlanarPath path({piece}, {2.0});
  const double u = 0.5;  // at t = 1 s
  EXPECT_NEAR(path.position(1.0).x(),
              1 + 2 * u + 3 * u * u + 4 * std::pow(u, 3) + 5 * std::pow(u, 4) + 6 * std::pow(u, 5),
              1e-12);
  EXPECT_NEAR(path.derivative(1.0, 1).x(),
              (2 + 6 * u + 12 * u * u + 20 * std::pow(u, 3) + 30 * std::pow(u, 4)) / 2.0, 1e-12);
  EXPECT_NEAR(path.derivative(1.0, 5).x(), 720.0 / 32.0, 1e-12);
  EXPECT_EQ(path.derivative(1.0, 6).norm(), 0.0);
}

TEST(PiecewisePolynomial, LocatesAndClamps) {
  const PlanarPath path = random_drive(1, 4).path;
  EXPECT_EQ(path.locate(-1.0).piece, 0);
  EXPECT_EQ(path.locate(-1.0).u, 0.0);
  EXPECT_EQ(path.locate(path.duration() + 1.0).piece, 3);
  EXPECT_EQ(path.locate(path.duration() + 1.0).u, 1.0);
  EXPECT_EQ(path.locate(path.piece_start(2)).piece, 2);
  EXPECT_NEAR(path.locate(path.piece_start(2) + 0.1).u, 0.1 / path.piece_duration(2), 1e-12);
}

TEST(PiecewisePolynomial, SlicesAreTheSameCurve) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const PlanarPath path = random_drive(trial, 1 + trial % 9).path;
    std::uniform_real_distribution<double> when(0.0, path.duration());
    double t0 = when(random);
    double t1 = when(random);
    if (t0 > t1) std::swap(t0, t1);
    if (trial % 5 == 0) t0 = path.piece_start(path.pieces() - 1);  // exactly at a knot
    if (trial % 7 == 0) t0 = 0.0;
    if (t1 - t0 < 1e-3) t1 = path.duration();
    const PlanarPath part = path.slice(t0, t1);
    EXPECT_NEAR(part.duration(), t1 - t0, 1e-6 * path.pieces());
    for (double t = 0.0; t < part.duration(); t += 0.01) {
      for (int order = 0; order <= 2; ++order) {
        EXPECT_LT((part.derivative(t, order) - path.derivative(t0 + t, order)).norm(), 1e-7);
      }
    }
  }
}

TEST(PiecewisePolynomial, SlicesHaveNoSlivers) {
  const PlanarPath path = random_drive(3, 5).path;
  const double t0 = path.piece_start(1) - 1e-4;
  const double t1 = path.piece_start(4) + 1e-4;
  const PlanarPath part = path.slice(t0, t1);
  ASSERT_EQ(part.pieces(), 3);
  EXPECT_NEAR(part.duration(), t1 - t0, 1e-12);
  for (double t = 0.0; t <= part.duration(); t += 1e-4) {
    for (int order = 0; order <= 2; ++order) {
      EXPECT_LT((part.derivative(t, order) - path.derivative(t0 + t, order)).norm(), 1e-7);
    }
  }
  const PlanarPath all_there_is = path.slice(path.piece_start(2) - 1e-4, path.piece_start(2));
  EXPECT_NEAR(all_there_is.duration(), 1e-4, 1e-12);
}

TEST(PiecewisePolynomial, SliceRefusesTimesOutside) {
  const PlanarPath path = random_drive(1, 3).path;
  EXPECT_THROW(path.slice(-0.1, 1.0), std::invalid_argument);
  EXPECT_THROW(path.slice(1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(path.slice(1.0, path.duration() + 0.1), std::invalid_argument);
  EXPECT_THROW(path.slice(std::nan(""), 1.0), std::invalid_argument);
}

TEST(PiecewisePolynomial, StretchingSlowsTheSamePath) {
  const PlanarPath path = random_drive(2, 5).path;
  const PlanarPath slow = path.stretched(2.0);
  EXPECT_NEAR(slow.duration(), 2.0 * path.duration(), 1e-12);
  for (double t = 0.0; t < path.duration(); t += 0.1) {
    EXPECT_LT((slow.position(2.0 * t) - path.position(t)).norm(), 1e-9);
    EXPECT_LT((slow.derivative(2.0 * t, 1) - 0.5 * path.derivative(t, 1)).norm(), 1e-9);
    EXPECT_LT((slow.derivative(2.0 * t, 2) - 0.25 * path.derivative(t, 2)).norm(), 1e-9);
  }
}

template <typename Case>
class PiecewisePolynomialTest : public ::testing::Test {};
TYPED_TEST_SUITE(PiecewisePolynomialTest, test::AllCases);

TYPED_TEST(PiecewisePolynomialTest, DerivesSlicesAndStretches) {
  using Curve = PiecewisePolynomial<TypeParam::D, TypeParam::S>;
  using Vector = typename Curve::Vector;
  const Curve curve = test::Problem<TypeParam::D, TypeParam::S>(5, 2).solved().curve();
  const double t0 = 0.3 * curve.duration();
  const Curve part = curve.slice(t0, curve.duration());
  const Curve slow = curve.stretched(3.0);
  for (double t = 0.01; t + 0.01 < part.duration(); t += 0.1) {
    for (int order = 1; order < Curve::kCoefficients; ++order) {
      const double h = 1e-4;
      const Vector value = curve.derivative(t0 + t, order);
      const Vector rise =
          curve.derivative(t0 + t + h, order - 1) - curve.derivative(t0 + t - h, order - 1);
      const bool smooth = curve.locate(t0 + t - h).piece == curve.locate(t0 + t + h).piece;
      if (smooth) {
        EXPECT_LT((rise / (2.0 * h) - value).norm(), 1e-5 * (1.0 + value.norm()));
      }
      EXPECT_LT((part.derivative(t, order) - value).norm(), 1e-7 * (1.0 + value.norm())) << order;
      EXPECT_LT((slow.derivative(3.0 * (t0 + t), order) * std::pow(3.0, order) - value).norm(),
                1e-7 * (1.0 + value.norm()));
      if (order < TypeParam::S) {
        EXPECT_EQ(curve.state(t0 + t).col(order), value);
      }
    }
  }
}

}  // namespace
}  // namespace mocha
