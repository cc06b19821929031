#include "planning/candidates/speed_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocha {
namespace {

const MotionLimits kLimits{2.0, 1.0, 1.5, 4.0};

InitialKnots<2> spread(const std::vector<Vector2>& points, double start_speed = 0.0,
                       double spacing_m = 0.5) {
  const InitialKnots<2> knots = spread_knots<2>(points, start_speed, kLimits, spacing_m);
  EXPECT_EQ(knots.path.cols(), knots.durations_s.size() + 1);
  EXPECT_GE(knots.durations_s.size(), 2);
  EXPECT_GT(knots.durations_s.minCoeff(), 0.0);
  EXPECT_TRUE(knots.path.allFinite());
  EXPECT_LT((knots.path.col(0) - points.front()).norm(), 1e-9);
  EXPECT_LT((knots.path.rightCols(1) - points.back()).norm(), 1e-9);
  return knots;
}

/// Mean speed between two knots.
double speed(const InitialKnots<2>& knots, int piece) {
  return (knots.path.col(piece + 1) - knots.path.col(piece)).norm() / knots.durations_s[piece];
}

TEST(SpeedProfile, StraightIsATrapezoid) {
  const InitialKnots<2> knots = spread({{0.0, 0.0}, {20.0, 0.0}});
  const int pieces = static_cast<int>(knots.durations_s.size());
  EXPECT_LT(speed(knots, 0), 0.3);
  EXPECT_NEAR(speed(knots, pieces / 2), kLimits.max_speed, 1e-6);
  EXPECT_LT(speed(knots, pieces - 1), 0.3);
  // Not faster than the limits allow, and not much slower: the ramps use a part of the
  // acceleration.
  EXPECT_GE(knots.durations_s.sum(), 20.0 / 2.0 + 2.0 / 1.0 - 1e-9);
  EXPECT_LE(knots.durations_s.sum(), 20.0 / 2.0 + 2.0 / 0.5);
  for (int k = 0; k < pieces; ++k) EXPECT_GT(knots.path(0, k + 1), knots.path(0, k));
}

TEST(SpeedProfile, KnotsAreTheSpacingApartAtFullSpeedAndUniformInTime) {
  const InitialKnots<2> knots = spread({{0.0, 0.0}, {20.0, 0.0}}, 0.0, 0.8);
  const int middle = static_cast<int>(knots.durations_s.size()) / 2;
  EXPECT_NEAR((knots.path.col(middle + 1) - knots.path.col(middle)).norm(), 0.8, 0.03);
  EXPECT_NEAR(knots.durations_s.maxCoeff(), knots.durations_s.minCoeff(), 1e-12);
}

TEST(SpeedProfile, GoesOnAtTheSpeedItHas) {
  EXPECT_GT(speed(spread({{0.0, 0.0}, {20.0, 0.0}}, 1.8), 0), 1.7);
  EXPECT_LT(spread({{0.0, 0.0}, {20.0, 0.0}}, 1.8).durations_s.sum(),
            spread({{0.0, 0.0}, {20.0, 0.0}}, 0.0).durations_s.sum());
  spread({{0.0, 0.0}, {0.3, 0.0}}, 2.0);  // cannot stop in time: still a profile
}

TEST(SpeedProfile, IsSlowerInCorners) {
  const InitialKnots<2> knots = spread({{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}}, 0.0, 0.4);
  double slowest = kLimits.max_speed;
  for (int k = 0; k < knots.durations_s.size(); ++k) {
    const Vector2 middle = 0.5 * (knots.path.col(k) + knots.path.col(k + 1));
    if ((middle - Vector2(10.0, 0.0)).norm() < 0.3) slowest = std::min(slowest, speed(knots, k));
    if ((middle - Vector2(5.0, 0.0)).norm() > 0.3) continue;
    EXPECT_GT(speed(knots, k), 1.5);
  }
  EXPECT_LT(slowest, 0.8);
  EXPECT_GT(slowest, 0.05);
}

TEST(SpeedProfile, RespectsTheYawRate) {
  std::vector<Vector2> circle;  // of 2 m
  for (double angle = -M_PI / 2.0; angle < M_PI; angle += 0.05) {
    circle.push_back(2.0 * Vector2(std::cos(angle), std::sin(angle)));
  }
  MotionLimits lazy = kLimits;
  lazy.max_yaw_rate = 0.2;
  const InitialKnots<2> knots = spread_knots<2>(circle, 0.0, lazy, 0.5);
  const int pieces = static_cast<int>(knots.durations_s.size());
  // Towards the ends, which stay where they are, the rounding straightens the path a little.
  const int margin = static_cast<int>(pieces * 0.5 / (1.5 * M_PI * 2.0)) + 1;
  for (int k = margin; k < pieces - margin; ++k) EXPECT_LT(speed(knots, k), 1.05 * 0.2 * 2.0);
  EXPECT_GT(speed(knots, static_cast<int>(knots.durations_s.size()) / 2), 0.9 * 0.2 * 2.0);
}

TEST(SpeedProfile, IsSlowerWhereAPlaceAsksForIt) {
  const auto narrow = [](const Vector2& place) {
    return std::abs(place.x() - 10.0) < 1.0 ? 0.5 : 9.0;
  };
  const InitialKnots<2> knots =
      spread_knots<2>({{0.0, 0.0}, {20.0, 0.0}}, 0.0, kLimits, 0.4, narrow);
  for (int k = 0; k < knots.durations_s.size(); ++k) {
    const double first = knots.path(0, k);
    const double last = knots.path(0, k + 1);
    if (first > 9.1 && last < 10.9) {
      EXPECT_NEAR(speed(knots, k), 0.5, 1e-6);
    }
    if (first > 5.0 && last < 6.0) {
      EXPECT_GT(speed(knots, k), 1.9);
    }
  }
}

TEST(SpeedProfile, AGentleBendIsFasterThanASharpOne) {
  const auto duration_s = [](double turn_rad) {
    const Vector2 bend(10.0, 0.0);
    return spread({{0.0, 0.0}, bend, bend + 10.0 * Vector2(std::cos(turn_rad), std::sin(turn_rad))})
        .durations_s.sum();
  };
  EXPECT_LT(duration_s(0.05), duration_s(0.8));
  EXPECT_LT(duration_s(0.8), duration_s(2.5));
}

/// Distance from a path that goes right, up and right again.
double off_the_stairs_m(const Vector2& p) {
  const auto beside = [&](const Vector2& a, const Vector2& b) {
    const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - share * (b - a)).norm();
  };
  return std::min({beside({0.0, 0.0}, {3.0, 0.0}), beside({3.0, 0.0}, {3.0, 3.0}),
                   beside({3.0, 3.0}, {6.0, 3.0})});
}

TEST(SpeedProfile, KnotsLieOnThePathButInItsRoundedCorners) {
  constexpr double kWindow_m = 0.3;
  const InitialKnots<2> knots =
      spread({{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}, {6.0, 3.0}}, 0.5, kWindow_m);
  double farthest_m = 0.0;
  for (const Vector2& p : knots.path.colwise()) {
    const double from_corner_m =
        std::min((p - Vector2(3.0, 0.0)).norm(), (p - Vector2(3.0, 3.0)).norm());
    if (from_corner_m > kWindow_m) {
      EXPECT_LT(off_the_stairs_m(p), 1e-9);
    }
    farthest_m = std::max(farthest_m, off_the_stairs_m(p));
  }
  EXPECT_GT(farthest_m, 0.1 * kWindow_m);
  EXPECT_LT(farthest_m, 0.3 * kWindow_m);
}

TEST(SpeedProfile, RoundingTakesTheKinksOutOfTheKnots) {
  std::vector<Vector2> jittery;
  for (int i = 0; i <= 100; ++i) jittery.push_back({0.1 * i, i % 2 == 0 ? 0.02 : -0.02});
  const InitialKnots<2> knots = spread(jittery, 0.0, 1.0);
  EXPECT_LT(knots.path.middleCols(3, knots.path.cols() - 6).row(1).cwiseAbs().maxCoeff(), 0.002);
}

TEST(SpeedProfile, NextToNothingToDriveIsNoProblem) {
  spread({{1.0, 1.0}, {1.0, 1.0}});
  spread({{1.0, 1.0}, {1.0, 1.0 + 1e-12}});
  spread({{1.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}, {2.0, 1.0}});
}

TEST(SpeedProfile, FewerThanTwoPointsAreRefused) {
  EXPECT_THROW(spread_knots<2>({}, 0.0, kLimits, 0.5), std::invalid_argument);
  EXPECT_THROW(spread_knots<2>({{1.0, 1.0}}, 0.0, kLimits, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
