#include "trajectory/extrema.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trajectory/arc_length.h"
#include "trajectory/minco.h"

namespace mocha {
namespace {

template <int Dimension, int Order>
struct Case {
  static constexpr int D = Dimension;
  static constexpr int S = Order;
};

template <typename Case>
class Curves : public testing::Test {};
using Cases =
    testing::Types<Case<2, 2>, Case<2, 3>, Case<2, 4>, Case<3, 2>, Case<3, 3>, Case<3, 4>>;
TYPED_TEST_SUITE(Curves, Cases);

template <int D, int S>
PiecewisePolynomial<D, S> random_curve(int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-2.0, 2.0);
  std::uniform_real_distribution<double> duration(0.2, 3.0);
  const int pieces = 1 + seed % 5;
  Minco<D, S> minco;
  minco.resize(pieces);
  typename Minco<D, S>::Knots knots(D, pieces - 1);
  typename Minco<D, S>::State start;
  typename Minco<D, S>::State end;
  for (auto* matrix : {&start, &end})
    *matrix = matrix->unaryExpr([&](double) { return entry(random); });
  knots = knots.unaryExpr([&](double) { return entry(random); });
  Eigen::VectorXd durations(pieces);
  for (double& tau : durations) tau = duration(random);
  minco.solve(start, end, knots, durations);
  return minco.curve();
}

TYPED_TEST(Curves, ExtremaAreThoseOfDenseSamples) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  for (int seed = 1; seed <= 30; ++seed) {
    const auto curve = random_curve<D, S>(seed);
    const Extremum speed = max_speed(curve);
    const Extremum acceleration = max_acceleration(curve);
    double fastest = 0.0;
    double hardest = 0.0;
    constexpr int kSamples = 20000;
    for (int i = 0; i <= kSamples; ++i) {
      const double t = curve.duration() * i / kSamples;
      fastest = std::max(fastest, curve.derivative(t, 1).norm());
      hardest = std::max(hardest, curve.derivative(t, 2).norm());
    }
    EXPECT_GE(speed.value, fastest * (1.0 - 1e-12));
    EXPECT_NEAR(speed.value, fastest, 1e-4 * fastest);
    EXPECT_NEAR(curve.derivative(speed.time_s, 1).norm(), speed.value, 1e-8 * fastest);
    EXPECT_GE(acceleration.value, hardest * (1.0 - 1e-12));
    EXPECT_NEAR(acceleration.value, hardest, 1e-3 * hardest);
  }
}

TYPED_TEST(Curves, LengthIsThatOfDenseChords) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  for (int seed = 1; seed <= 30; ++seed) {
    const auto curve = random_curve<D, S>(seed);
    double chords = 0.0;
    constexpr int kSamples = 20000;
    for (int i = 1; i <= kSamples; ++i) {
      const double step = curve.duration() / kSamples;
      chords += (curve.position(i * step) - curve.position((i - 1) * step)).norm();
    }
    EXPECT_GE(arc_length(curve), chords * (1.0 - 1e-9));
    EXPECT_NEAR(arc_length(curve), chords, 1e-5 * chords);
  }
}

TYPED_TEST(Curves, StretchedByTheFactorTheyJustKeepTheirLimits) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  for (int seed = 1; seed <= 30; ++seed) {
    const auto curve = random_curve<D, S>(seed);
    const double factor = stretch_within(curve, 1.0, 0.8);
    const auto stretched = curve.stretched(factor);
    const double speed = max_speed(stretched).value;
    const double acceleration = max_acceleration(stretched).value;
    EXPECT_LE(speed, 1.0 + 1e-9);
    EXPECT_LE(acceleration, 0.8 * (1.0 + 1e-9));
    if (factor > 1.0) {
      EXPECT_NEAR(std::max(speed, acceleration / 0.8), 1.0, 1e-6);
    }
    EXPECT_EQ(stretch_within(curve, 1e6, 1e6), 1.0);
  }
}

TEST(Extrema, OfAParabolaAreAtItsEnd) {
  // x = u^2 over 2 s: speed up to 1 m/s, acceleration 0.5 m/s^2 all along.
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  piece(0, 2) = 1.0;
  const PlanarPath curve({piece}, {2.0});
  EXPECT_NEAR(max_speed(curve).value, 1.0, 1e-9);
  EXPECT_NEAR(max_speed(curve).time_s, 2.0, 1e-9);
  EXPECT_NEAR(max_acceleration(curve).value, 0.5, 1e-9);
  EXPECT_NEAR(arc_length(curve), 1.0, 1e-9);
}

TEST(Extrema, OfWhatStandsStillAreZero) {
  const PlanarPath curve({PlanarPath::Piece::Zero()}, {2.0});
  EXPECT_EQ(max_speed(curve).value, 0.0);
  EXPECT_EQ(max_acceleration(curve).value, 0.0);
  EXPECT_EQ(arc_length(curve), 0.0);
  EXPECT_EQ(stretch_within(curve, 1.0, 1.0), 1.0);
}

}  // namespace
}  // namespace mocha
