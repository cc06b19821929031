#include "safety/curve_certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "trajectory/minco.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using Vector3 = Eigen::Vector3d;
template <int D>
using Curve = PiecewisePolynomial<D, 3>;

/// From rest to rest along a straight line.
template <int D>
Curve<D> straight(const typename Curve<D>::Vector& from, const typename Curve<D>::Vector& to,
                  double duration_s) {
  typename Curve<D>::Piece piece = Curve<D>::Piece::Zero();
  piece.col(0) = from;
  piece.col(3) = 10.0 * (to - from);
  piece.col(4) = -15.0 * (to - from);
  piece.col(5) = 6.0 * (to - from);
  return Curve<D>({piece}, {duration_s});
}

/// A winding curve of minimum jerk from rest to rest.
template <int D>
Curve<D> winding(int seed, int pieces) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto anywhere = [&] {
    typename Curve<D>::Vector p;
    for (double& value : p) value = unit(random);
    return p;
  };
  typename Minco<D, 3>::Knots knots(D, pieces - 1);
  typename Curve<D>::Vector place = Curve<D>::Vector::Zero();
  typename Curve<D>::Vector course = anywhere();
  for (int i = 0; i < pieces - 1; ++i) {
    course = (course + 0.8 * anywhere()).normalized();
    knots.col(i) = place += course;
  }
  typename Curve<D>::State start = Curve<D>::State::Zero();
  typename Curve<D>::State end = Curve<D>::State::Zero();
  end.col(0) = place + course;
  Eigen::VectorXd durations(pieces);
  for (int i = 0; i < pieces; ++i) durations[i] = 0.9 + 0.3 * unit(random);
  Minco<D, 3> minco;
  minco.resize(pieces);
  minco.solve(start, end, knots, durations);
  return minco.curve();
}

TEST(CurveCertificate, TellsAMillimetreBesideFromAMillimetreInside) {
  constexpr double kRadius_m = 0.3;
  constexpr double kMargin_m = 0.1;
  const auto flight = straight<3>({-5.0, 0.0, 1.0}, {5.0, 0.0, 1.0}, 6.0);
  const CurveCertificate<3, 3> certificate(flight);
  const double height = 1.0 - kRadius_m - kMargin_m;
  const auto near = [&](double gap_m) {  // a column beside the path, a plate below, one above
    return std::vector<Cylinder>{
        {{1.0, 2.0 + kRadius_m + kMargin_m + gap_m}, 2.0},
        {{-2.0, 0.0}, 0.5, 0.0, height - gap_m},
        {{3.0, 0.0}, 0.0, 1.0 + kRadius_m + kMargin_m + gap_m, 9.0},
    };
  };
  for (int i = 0; i < 3; ++i) {
    const PrimitiveField<3> beside({near(1e-3)[i]}, 1.0);
    const auto fine = certificate.check_clearance(kRadius_m, beside, kMargin_m);
    EXPECT_FALSE(fine) << i << ": " << describe(fine);
    const PrimitiveField<3> inside({near(-1e-3)[i]}, 1.0);
    const auto violation = certificate.check_clearance(kRadius_m, inside, kMargin_m);
    ASSERT_TRUE(violation) << i;
    EXPECT_EQ(violation.term, ViolatedTerm::kClearance);
    EXPECT_EQ(violation.limit, kMargin_m);
    EXPECT_NEAR(violation.value, kMargin_m - 1e-3, 1e-5) << i;
    EXPECT_EQ(violation.place, flight.position(violation.time_s));
    EXPECT_LT((violation.place - Vector3(std::array{1.0, -2.0, 3.0}[i], 0.0, 1.0)).norm(), 0.6);
  }
}

TEST(CurveCertificate, ReportsTheWorstOfTheFirstStretchOnly) {
  const CurveCertificate<2, 3> certificate(straight<2>({0.0, 0.0}, {10.0, 0.0}, 8.0));
  const PrimitiveField<2> field({Circle{{3.0, 1.4}, 1.0}, Circle{{7.0, 1.2}, 1.0}}, 1.0);
  const auto violation = certificate.check_clearance(0.3, field, 0.2);
  EXPECT_NEAR(violation.value, 0.1, 1e-4);
  EXPECT_NEAR(violation.place.x(), 3.0 - std::sqrt(1.5 * 1.5 - 1.4 * 1.4), 2e-3);
}

TEST(CurveCertificate, FindsANeedleBetweenSamples) {
  // 10 m in 2.5 s with a ball of 1 mm, and a wire of 0.1 mm: sampling at 1 kHz misses it.
  const CurveCertificate<3, 3> certificate(straight<3>({0, 0, 5}, {10, 0, 5}, 2.5));
  for (double x = 0.2137; x < 9.8; x += 0.2) {
    const PrimitiveField<3> wire({Cylinder{{x, 0.0}, 1e-4}}, 1.0);
    const auto violation = certificate.check_clearance(1e-3, wire, 0.0);
    ASSERT_TRUE(violation) << x;
    EXPECT_NEAR(violation.place.x(), x, 3e-3);
    const PrimitiveField<3> beside({Cylinder{{x, 2.2e-3}, 1e-4}}, 1.0);
    EXPECT_FALSE(certificate.check_clearance(1e-3, beside, 0.0)) << x;
    const PrimitiveField<3> below({Cylinder{{x, 0.0}, 1e-4, 0.0, 5.0 - 2.2e-3}}, 1.0);
    EXPECT_FALSE(certificate.check_clearance(1e-3, below, 0.0)) << x;
  }
}

TEST(CurveCertificate, FindsAnExcessInTheMiddleOfAPiece) {
  // Peaks of the quintic over a length L in the time T: speed 15/8 L/T in the middle, acceleration
  // 10/sqrt(3) L/T^2 before and after.
  constexpr double kLength_m = 6.0;
  constexpr double kTime_s = 4.0;
  const CurveCertificate<3, 3> certificate(
      straight<3>({1.0, 2.0, 3.0}, {1.0 + 2.0, 2.0 + 4.0, 3.0 + 4.0}, kTime_s));
  const double speed = 15.0 / 8.0 * kLength_m / kTime_s;
  const double acceleration = 10.0 / std::sqrt(3.0) * kLength_m / (kTime_s * kTime_s);
  EXPECT_FALSE(certificate.check_limits(speed, acceleration));
  const auto fast = certificate.check_limits(speed * (1.0 - 1e-5), acceleration);
  ASSERT_EQ(fast.term, ViolatedTerm::kSpeed);
  EXPECT_NEAR(fast.time_s, 0.5 * kTime_s, 0.01);
  EXPECT_NEAR(fast.value, speed, 1e-4);
  EXPECT_EQ(fast.limit, speed * (1.0 - 1e-5));
  EXPECT_LT((fast.place - Vector3(2.0, 4.0, 5.0)).norm(), 0.05);
  const auto hard = certificate.check_limits(speed, acceleration * (1.0 - 1e-5));
  ASSERT_EQ(hard.term, ViolatedTerm::kAcceleration);
  EXPECT_NEAR(hard.time_s, (0.5 - std::sqrt(1.0 / 12.0)) * kTime_s, 0.01);
  EXPECT_NEAR(hard.value, acceleration, 1e-4);
}

TEST(CurveCertificate, FindsASpikeOfMilliseconds) {
  // 1 m/s, and for 2 ms in the middle a wiggle e u^2 (1 - u)^2 along the path: 2 e / tau^2.
  constexpr double kTau_s = 0.002;
  using Piece = Curve<2>::Piece;
  for (const double acceleration : {1.1, 1.3}) {
    const double e = 0.5 * acceleration * kTau_s * kTau_s;
    Piece before = Piece::Zero();
    Piece spike = Piece::Zero();
    before.row(0).head<2>() << 0.0, 1.003;
    spike.row(0).head<5>() << 1.003, kTau_s, e, -2.0 * e, e;
    const auto violation =
        CurveCertificate<2, 3>(Curve<2>({before, spike}, {1.003, kTau_s})).check_limits(2.0, 1.2);
    EXPECT_EQ(static_cast<bool>(violation), acceleration > 1.2);
    if (!violation) continue;
    EXPECT_EQ(violation.term, ViolatedTerm::kAcceleration);
    EXPECT_NEAR(violation.time_s, 1.003, kTau_s);
  }
}

TEST(CurveCertificate, RefusesJumpsAtAKnot) {
  using Piece = Curve<3>::Piece;
  const auto check = [](const Vector3& from, const Vector3& velocity) {
    Piece first = Piece::Zero();
    Piece second = Piece::Zero();
    first.col(1) = Vector3(1.0, 0.0, 0.0);
    second.col(0) = from;
    second.col(1) = velocity;
    return CurveCertificate<3, 3>(Curve<3>({first, second}, {1.0, 1.0})).check_limits(2.0, 2.0);
  };
  EXPECT_FALSE(check({1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  const auto place = check({1.0, 0.0, 0.5}, {1.0, 0.0, 0.0});
  EXPECT_EQ(place.term, ViolatedTerm::kSpeed);
  EXPECT_EQ(place.time_s, 1.0);
  EXPECT_TRUE(std::isinf(place.value));
  const auto velocity = check({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  EXPECT_EQ(velocity.term, ViolatedTerm::kAcceleration);
  EXPECT_EQ(velocity.place, Vector3(1.0, 0.0, 0.0));
}

template <typename Dimension>
class CurveCertificates : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CurveCertificates, Dimensions);

/// Obstacles close to a curve, none of them on it.
template <int D>
PrimitiveField<D> clutter(const Curve<D>& curve, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<typename PrimitiveField<D>::Primitive> primitives;
  for (int i = 0; i < 60; ++i) {
    const Vector2 beside = curve.position(share(random) * curve.duration()).template head<2>();
    const double angle = 2.0 * M_PI * share(random);
    const Vector2 centre =
        beside + (0.7 + share(random)) * Vector2(std::cos(angle), std::sin(angle));
    const double radius = 0.02 + 0.3 * share(random);
    typename PrimitiveField<D>::Primitive primitive;
    if constexpr (D == 2) {
      primitive = Circle{centre, radius};
    } else {
      const double low = 4.0 * share(random) - 3.0;
      primitive = Cylinder{centre, radius, low, low + 2.0 * share(random)};
    }
    const PrimitiveField<D> alone({primitive}, 0.8);
    double room = std::numeric_limits<double>::infinity();
    for (double t = 0.0; t < curve.duration(); t += 0.05) {
      room = std::min(room, alone.distance_bound(curve.position(t)));
    }
    if (room > 0.2) primitives.push_back(primitive);
  }
  return PrimitiveField<D>(primitives, 0.8);
}

TYPED_TEST(CurveCertificates, AgreeWithDenseSampling) {
  constexpr int D = TypeParam::value;
  constexpr int kSamples = 20000;
  int accepted = 0;
  int refused = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const Curve<D> curve = winding<D>(seed, 2 + seed % 7);
    const PrimitiveField<D> field = clutter<D>(curve, seed);
    const CurveCertificate<D, 3> certificate(curve);
    double room = std::numeric_limits<double>::infinity();
    double speed = 0.0;
    double acceleration = 0.0;
    for (int i = 0; i <= kSamples; ++i) {
      const double t = curve.duration() * i / kSamples;
      room = std::min(room, field.distance_bound(curve.position(t)));
      speed = std::max(speed, curve.derivative(t, 1).norm());
      acceleration = std::max(acceleration, curve.derivative(t, 2).norm());
    }
    for (const double gap : {-1e-3, -1e-6, 1e-3, 0.05}) {
      const double radius = 0.5 * room;
      const auto violation = certificate.check_clearance(radius, field, room - radius - gap);
      EXPECT_EQ(static_cast<bool>(violation), gap < 0.0) << seed << " " << describe(violation);
      ++(violation ? refused : accepted);
      if (!violation) continue;
      const double needed = room - gap;
      EXPECT_LT(field.distance_bound(violation.place), needed + 1.1e-3);
      for (double t = 0.0; t < violation.time_s; t += 2e-3) {
        ASSERT_GE(field.distance_bound(curve.position(t)), needed) << seed << " " << t;
      }
    }
    EXPECT_FALSE(certificate.check_limits(speed * (1.0 + 1e-5), acceleration * (1.0 + 1e-5)));
    EXPECT_EQ(certificate.check_limits(speed * (1.0 - 1e-5), 1e3).term, ViolatedTerm::kSpeed);
    const auto hard = certificate.check_limits(1e3, 0.8 * acceleration);
    EXPECT_EQ(hard.term, ViolatedTerm::kAcceleration);
    for (double t = 0.0; t < hard.time_s - 1e-6; t += 1e-3) {
      ASSERT_LE(curve.derivative(t, 2).norm(), hard.limit * (1.0 + 2e-6)) << seed << " " << t;
    }
  }
  EXPECT_GT(accepted, 60);
  EXPECT_GT(refused, 60);
}

/// Something that moves through the curve's places, two pieces long.
template <int D>
Tube<D> crossing(const Curve<D>& curve, int seed) {
  using Place = typename TubePiece<D>::Place;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double middle_s = (0.3 + 0.2 * uniform(random)) * curve.duration();
  Place aside, velocity, later;
  for (int axis = 0; axis < D; ++axis) {
    aside[axis] = uniform(random);
    velocity[axis] = uniform(random);
    later[axis] = uniform(random);
  }
  TubePiece<D> first{-1.0, middle_s, Place::Zero(), velocity, 0.2, 0.0};
  first.centre = curve.position(middle_s) + aside - (middle_s + 1.0) * velocity;
  const TubePiece<D> second{middle_s, 0.9 * curve.duration(), first.centre_at(middle_s), later, 0.2,
                            0.0};
  return {first, second};
}

TYPED_TEST(CurveCertificates, AgreeWithDenseSamplingOnWhatMoves) {
  constexpr int D = TypeParam::value;
  constexpr double kRadius_m = 0.1;
  int accepted = 0;
  int refused = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const Curve<D> curve = winding<D>(seed, 2 + seed % 5);
    const Tube<D> tube = crossing<D>(curve, seed);
    double room = std::numeric_limits<double>::infinity();
    for (const TubePiece<D>& piece : tube) {
      for (double t = std::max(0.0, piece.start_s); t < piece.end_s; t += 2e-4)
        room = std::min(room, (curve.position(t) - piece.centre_at(t)).norm() - piece.radius_at(t));
    }
    if (room < kRadius_m) continue;
    const CurveCertificate<D, 3> certificate(curve);
    for (const double gap : {-2e-3, 2e-3}) {
      const auto violation = certificate.check_separation(kRadius_m, tube, room - kRadius_m - gap);
      EXPECT_EQ(static_cast<bool>(violation), gap < 0.0) << seed << " " << describe(violation);
      ++(violation ? refused : accepted);
      if (!violation) continue;
      EXPECT_EQ(violation.term, ViolatedTerm::kSeparation);
      EXPECT_LT(violation.value, violation.limit + 1.1e-3);
    }
  }
  EXPECT_GT(accepted, 20);
  EXPECT_GT(refused, 20);
}

TYPED_TEST(CurveCertificates, WhatGrowsOrShrinksIsNeverTakenForSmaller) {
  constexpr int D = TypeParam::value;
  for (int seed = 0; seed < 60; ++seed) {
    const Curve<D> curve = winding<D>(seed, 2 + seed % 5);
    TubePiece<D> ball = crossing<D>(curve, seed).front();
    ball.radius_rate = 0.2 * std::sin(seed);
    const double largest_m = std::max(ball.radius_at(0.0), ball.radius_at(ball.end_s));
    double room = std::numeric_limits<double>::infinity();
    double least_room = room;  // if it were always as large as it gets
    for (double t = 0.0; t < ball.end_s; t += 2e-4) {
      const double away_m = (curve.position(t) - ball.centre_at(t)).norm();
      room = std::min(room, away_m - ball.radius_at(t));
      least_room = std::min(least_room, away_m - largest_m);
    }
    if (ball.radius_at(ball.end_s) < 0.0 || ball.radius_at(0.0) < 0.0 || least_room < 0.01)
      continue;
    const CurveCertificate<D, 3> certificate(curve);
    EXPECT_TRUE(certificate.check_separation(0.0, {ball}, room + 2e-3)) << seed;
    EXPECT_FALSE(certificate.check_separation(0.0, {ball}, least_room - 2e-3)) << seed;
  }
}

TYPED_TEST(CurveCertificates, NotANumberIsNoProof) {
  constexpr int D = TypeParam::value;
  const double nan = std::nan("");
  const CurveCertificate<D, 3> certificate(winding<D>(1, 4));
  const PrimitiveField<D> open({}, 1.0);
  EXPECT_FALSE(certificate.check_clearance(0.3, open, 0.1));
  EXPECT_TRUE(certificate.check_clearance(nan, open, 0.1));
  EXPECT_TRUE(certificate.check_clearance(0.3, open, nan));
  const Tube<D> lost_tube = {
      {0.0, 9.0, Curve<D>::Vector::Constant(nan), Curve<D>::Vector::Zero(), 0.2, 0.0}};
  EXPECT_TRUE(certificate.check_separation(0.3, lost_tube, 0.1));
  EXPECT_TRUE(certificate.check_limits(nan, 100.0));
  EXPECT_TRUE(certificate.check_limits(100.0, nan));
  typename Curve<D>::Piece lost = Curve<D>::Piece::Zero();
  lost(0, 2) = nan;
  const CurveCertificate<D, 3> nowhere(Curve<D>({lost}, {1.0}));
  EXPECT_TRUE(nowhere.check_clearance(0.3, open, 0.1));
  EXPECT_TRUE(nowhere.check_limits(100.0, 100.0));
  EXPECT_THROW((CurveCertificate<D, 3>(Curve<D>())), std::invalid_argument);
}

TEST(CurveCertificate, SaysWhereInSpace) {
  const BasicViolation<3> violation{ViolatedTerm::kSpeed, 12.5, {1.0, -2.0, 3.5}, 1.25, 1.0, ""};
  EXPECT_EQ(describe(violation), "speed 1.250 m/s, limit 1.000, at (1.00, -2.00, 3.50)");
}

}  // namespace
}  // namespace mocha
