#include "trajectory/extrema.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "trajectory/minco_problem.h"
#include "trajectory/random_motion.h"

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <int D, int S>
double curvature(const PiecewisePolynomial<D, S>& curve, double t) {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  v.template head<D>() = curve.derivative(t, 1);
  a.template head<D>() = curve.derivative(t, 2);
  return v.cross(a).norm() / std::pow(v.norm(), 3);
}

/// The bound holds everywhere, is reached where it says, and no sample comes closer than that.
template <typename Function>
void expect_maximum(const Extremum& found, double from_s, double to_s, const Function& at) {
  double sampled = 0.0;
  for (int i = 0; i <= 20000; ++i) {
    sampled = std::max(sampled, at(from_s + (to_s - from_s) * i / 20000));
  }
  EXPECT_GE(found.value, sampled);
  EXPECT_LT(found.value, 1.001 * sampled);
  EXPECT_GE(found.value, at(found.time_s) * (1.0 - 1e-12));
  EXPECT_LE(found.value, at(found.time_s) * (1.0 + 1.1e-9));
}

template <typename Case>
class ExtremaTest : public ::testing::Test {};
TYPED_TEST_SUITE(ExtremaTest, test::AllCases);

TYPED_TEST(ExtremaTest, BoundDenseSamplesTightly) {
  for (int seed = 0; seed < 6; ++seed) {
    const test::Problem<TypeParam::D, TypeParam::S> problem(1 + 2 * seed, seed);
    const auto curve = problem.solved().curve();
    const double end = curve.duration();
    expect_maximum(max_speed(curve), 0.0, end,
                   [&](double t) { return curve.derivative(t, 1).norm(); });
    expect_maximum(max_acceleration(curve), 0.0, end,
                   [&](double t) { return curve.derivative(t, 2).norm(); });
    const Extremum bend = max_curvature(curve);
    EXPECT_TRUE(std::isfinite(bend.value));
    EXPECT_LE(bend.value, curvature(curve, bend.time_s) * (1.0 + 1e-8));
    for (int i = 0; i <= 20000; ++i) EXPECT_GE(bend.value, curvature(curve, end * i / 20000));
  }
}

/// One piece from the coefficients of t^k, which is normalised time over `tau` seconds.
PlanarPath path_of(std::initializer_list<double> x, std::initializer_list<double> y,
                   double tau = 1.0) {
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  std::copy(x.begin(), x.end(), piece.row(0).begin());
  std::copy(y.begin(), y.end(), piece.row(1).begin());
  return PlanarPath({piece}, {tau});
}

TEST(Extrema, OfAMinimumJerkProfileAreKnown) {
  const PlanarPath path = path_of({0, 0, 0, 10, -15, 6}, {0, 0, 0, 20, -30, 12}, 2.0);
  const double length = std::sqrt(5.0);
  EXPECT_NEAR(max_speed(path).value, 1.875 * length / 2.0, 2e-9);
  EXPECT_NEAR(max_speed(path).time_s, 1.0, 1e-3);
  EXPECT_NEAR(max_acceleration(path).value, 10.0 / std::sqrt(3.0) * length / 4.0, 2e-9);
  EXPECT_NEAR(max_curvature(path).value, 0.0, 1e-9);  // straight, from rest to rest
}

TEST(Extrema, OfAParabolaAreKnown) {
  const PlanarPath path = path_of({-1, 2}, {1, -4, 4}, 4.0);  // (s, s^2) for s from -1 to 1
  EXPECT_NEAR(max_speed(path).value, 0.5 * std::sqrt(5.0), 1e-9);
  EXPECT_NEAR(max_acceleration(path).value, 0.5, 1e-9);
  EXPECT_NEAR(max_curvature(path).value, 2.0, 4e-9);
  EXPECT_NEAR(max_curvature(path).time_s, 2.0, 1e-3);
}

TEST(Extrema, OfACircleAreKnown) {
  // MINCO with its exact boundary states and many knots follows a circle of radius 2 at 1.5 rad/s.
  constexpr int kPieces = 40;
  const auto at = [](double t) {
    PlanarPath::State state;
    const double c = 2.0 * std::cos(1.5 * t);
    const double s = 2.0 * std::sin(1.5 * t);
    state << c, -1.5 * s, -2.25 * c, s, 1.5 * c, -2.25 * s;
    return state;
  };
  PlanarMinco::Knots knots(2, kPieces - 1);
  for (int k = 1; k < kPieces; ++k) knots.col(k - 1) = at(0.1 * k).col(0);
  PlanarMinco minco;
  minco.resize(kPieces);
  minco.solve(at(0.0), at(0.1 * kPieces), knots, Eigen::VectorXd::Constant(kPieces, 0.1));
  EXPECT_NEAR(max_speed(minco.curve()).value, 3.0, 1e-5);
  EXPECT_NEAR(max_acceleration(minco.curve()).value, 4.5, 1e-3);
  EXPECT_NEAR(max_curvature(minco.curve()).value, 0.5, 1e-4);
}

TEST(Extrema, ARestAtAnEndCountsByItsLimit) {
  // s = t^2 (or t^3) along the parabola (s, s^2): the path is smooth, the curvature at its
  // vertex 2.
  EXPECT_NEAR(max_curvature(path_of({0, 0, 1}, {0, 0, 0, 0, 1})).value, 2.0, 4e-9);
  EXPECT_EQ(max_curvature(path_of({0, 0, 1}, {0, 0, 0, 0, 1})).time_s, 0.0);
  // The same, backward in time: at rest at the end.
  const PlanarPath to_rest = path_of({1, -2, 1}, {1, -4, 6, -4, 1}, 3.0);
  EXPECT_NEAR(max_curvature(to_rest).value, 2.0, 4e-9);
  EXPECT_EQ(max_curvature(to_rest).time_s, 3.0);
  // With jerk only: (t^3, t^3 + a straight rest).
  EXPECT_NEAR(max_curvature(path_of({0, 0, 0, 1}, {0, 0, 0, 1})).value, 0.0, 1e-9);
  // (t^2, t^5): flat at the rest, so that the maximum is elsewhere.
  const PlanarPath flat = path_of({0, 0, 1}, {0, 0, 0, 0, 0, 1});
  expect_maximum(max_curvature(flat), 1e-3, 1.0, [&](double t) { return curvature(flat, t); });
}

TEST(Extrema, AStraightDriveFromRestToRestDoesNotBend) {
  for (int seed = 0; seed < 50; ++seed) {
    test::Problem<2, 3> problem(1 + seed % 4, seed);
    const Vector2 along(std::cos(seed), std::sin(seed));
    problem.start.setZero();
    problem.end << 5.0 * along, Vector2::Zero(), Vector2::Zero();
    double t = 0.0;
    for (int k = 1; k < problem.pieces(); ++k) {  // where minimum jerk passes anyway
      const double u = (t += problem.durations[k - 1]) / problem.durations.sum();
      problem.knots.col(k - 1) = 5.0 * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u) * along;
    }
    EXPECT_LT(max_curvature(problem.solved().curve()).value, 1e-9) << seed;
  }
}

TEST(Extrema, ADepartureThatTurnsAtOnceIsInfinitelySharp) {
  const PlanarPath by_acceleration = path_of({0, 0, 1}, {0, 0, 0, 1});  // y = x^1.5
  EXPECT_EQ(max_curvature(by_acceleration).value, kInfinity);
  EXPECT_EQ(max_curvature(by_acceleration).time_s, 0.0);
  EXPECT_GT(curvature(by_acceleration, 1e-6), 1e5);
  EXPECT_EQ(max_curvature(path_of({0, 0, 0, 1}, {0, 0, 0, 0, 1})).value, kInfinity);  // y = x^4/3
  EXPECT_EQ(max_curvature(path_of({1, -2, 1}, {1, -3, 3, -1}, 5.0)).value, kInfinity);
  EXPECT_EQ(max_curvature(path_of({1, -2, 1}, {1, -3, 3, -1}, 5.0)).time_s, 5.0);
}

TEST(Extrema, AStopOnTheWayIsInfinitelySharp) {
  // At s = t - 0.3: a cusp (s^2, s^3), a reversal on a line, a pause on a line.
  const PlanarPath cusp = path_of({0.09, -0.6, 1}, {-0.027, 0.27, -0.9, 1}, 2.0);
  EXPECT_EQ(max_curvature(cusp).value, kInfinity);
  EXPECT_NEAR(max_curvature(cusp).time_s, 0.6, 1e-6);
  EXPECT_EQ(max_curvature(path_of({0.09, -0.6, 1}, {0.18, -1.2, 2})).value, kInfinity);
  EXPECT_EQ(max_curvature(path_of({-0.027, 0.27, -0.9, 1}, {0})).value, kInfinity);
  // At a knot.
  const PlanarPath there = path_of({0, 0, 0, 10, -15, 6}, {0});
  const PlanarPath on = path_of({1, 0, 0, 10, -15, 6}, {0});
  const PlanarPath both({there.piece(0), on.piece(0)}, {1.0, 1.0});
  EXPECT_EQ(max_curvature(both).value, kInfinity);
  EXPECT_NEAR(max_curvature(both).time_s, 1.0, 1e-6);
  EXPECT_EQ(max_curvature(path_of({1}, {2})).value, kInfinity);  // stands
}

TEST(Extrema, ANearStopIsSharpButFinite) {
  for (const double gap : {1e-1, 1e-2, 1e-3, 1e-4}) {
    // (s^2, gap s) with s = t - 0.3: curvature 2 / gap^2 at the vertex.
    const PlanarPath path = path_of({0.09, -0.6, 1}, {-0.3 * gap, gap});
    EXPECT_NEAR(max_curvature(path).value * gap * gap / 2.0, 1.0, 2e-9) << gap;
    EXPECT_NEAR(max_curvature(path).time_s, 0.3, gap);
  }
}

TEST(Extrema, FarFromTheOriginNothingChanges) {
  const PlanarPath path = random_drive(3, 6).path;
  std::vector<PlanarPath::Piece> moved;
  for (int i = 0; i < path.pieces(); ++i) {
    moved.push_back(path.piece(i));
    moved.back().col(0) += Vector2(1e6, -1e6);
  }
  const PlanarPath far(moved, path.durations());
  EXPECT_EQ(max_speed(far).value, max_speed(path).value);
  EXPECT_EQ(max_acceleration(far).value, max_acceleration(path).value);
}

TEST(Extrema, StandingStillIsNoMotion) {
  EXPECT_EQ(max_speed(path_of({1}, {2})).value, 0.0);
  EXPECT_EQ(max_acceleration(path_of({1, 1}, {2})).value, 0.0);
}

TEST(Extrema, RefuseWhatIsNoCurve) {
  EXPECT_THROW(max_speed(PlanarPath()), std::invalid_argument);
  EXPECT_THROW(max_acceleration(PlanarPath()), std::invalid_argument);
  EXPECT_THROW(max_curvature(PlanarPath()), std::invalid_argument);
  EXPECT_THROW(max_speed(path_of({0, std::nan("")}, {0})), std::invalid_argument);
  EXPECT_THROW(max_curvature(path_of({0, INFINITY}, {0})), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
