#include "base/wheel_odometry.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

namespace mocha {
namespace {

constexpr double kInterval_s = 0.025;
constexpr double kTrack_m = 0.172;

std::int64_t odometer_cm(double metres) { return static_cast<std::int64_t>(100.0 * metres); }

/// A wheel that really rolls, and its two witnesses: a speed with a wrong scale and noise, and the
/// odometer.
struct Witnesses {
  double scale = 1.0;
  double noise = 0.0;
  double rolled_m = 0.0;
  double speed = 0.0;
  std::mt19937 random{3};

  void roll(double dt_s, double next) {
    rolled_m += 0.5 * dt_s * (speed + next);
    speed = next;
  }
  double reported() { return scale * speed + noise * std::normal_distribution<double>()(random); }
};

TEST(WheelTravel, StaysWithinACentimetreOfTheEncoderHoweverWrongTheSpeedIs) {
  for (const double scale : {0.0, 0.5, 0.9, 1.0, 1.2}) {
    Witnesses wheel{scale, 0.05};
    WheelTravel travel(2.0);
    double sum_m = 0.0;
    for (int i = 0; i < 40000; ++i) {
      wheel.roll(kInterval_s, 0.8 * std::sin(0.002 * i) + 0.2 * std::sin(0.05 * i));
      sum_m += travel.add(kInterval_s, wheel.reported(), odometer_cm(wheel.rolled_m));
      ASSERT_NEAR(sum_m, wheel.rolled_m, 0.021) << scale << " " << i;
    }
    EXPECT_EQ(travel.restarts(), 0);
  }
}

TEST(WheelTravel, IsFinerThanTheOdometer) {
  Witnesses wheel{1.0, 0.03};
  WheelTravel travel(2.0);
  double sum_m = 0.0;
  double square = 0.0;
  int count = 0;
  for (int i = 0; i < 4000; ++i) {
    wheel.roll(kInterval_s, 0.3 + 0.1 * std::sin(0.01 * i));
    sum_m += travel.add(kInterval_s, wheel.reported(), odometer_cm(wheel.rolled_m));
    if (i < 100) continue;
    square += std::pow(sum_m - wheel.rolled_m, 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(square / count), 0.002);  // the odometer alone: 0.0029 about its middle
}

/// A pulse in a millisecond is 0.38 m/s, so that most readings at 0.1 m/s are 0.
TEST(WheelTravel, SmoothsAReadingOfSinglePulses) {
  constexpr double kPulse_m = M_PI * 0.08 / 660.0;
  WheelTravel travel(2.0);
  double rolled_m = 0.0;
  double worst = 0.0;
  double sum = 0.0;
  for (int i = 0; i < 400; ++i) {
    rolled_m += 0.1 * kInterval_s;
    const double pulses =
        std::floor(rolled_m / kPulse_m) - std::floor((rolled_m - 1e-4) / kPulse_m);
    travel.add(kInterval_s, pulses * kPulse_m / 1e-3, odometer_cm(rolled_m));
    if (i < 40) continue;
    worst = std::max(worst, std::abs(travel.speed() - 0.1));
    sum += travel.speed() / 360;
  }
  EXPECT_NEAR(sum, 0.1, 0.01);
  EXPECT_LT(worst, 0.15);  // of a reading: 0.28
}

TEST(WheelTravel, SlowMotionIsNotStuckBetweenTwoCentimetres) {
  WheelTravel travel(2.0);
  double sum_m = travel.add(0.0, 0.0, 5);
  double rolled_m = 0.055;
  for (int i = 0; i < 20; ++i) {
    rolled_m += 0.01 * kInterval_s;
    sum_m += travel.add(kInterval_s, 0.01, odometer_cm(rolled_m));
  }
  EXPECT_NEAR(sum_m, 0.005, 2e-4);
}

TEST(WheelTravel, ARestartedBaseDoesNotThrowTheRobotBack) {
  WheelTravel travel(2.0);
  travel.add(0.0, 0.0, 4000);
  EXPECT_NEAR(travel.add(kInterval_s, 0.0, 4000), 0.0, 1e-12);
  EXPECT_EQ(travel.add(kInterval_s, 0.0, 0), 0.0);
  EXPECT_EQ(travel.restarts(), 1);
  double sum_m = 0.0;
  for (int i = 1; i <= 100; ++i) sum_m += travel.add(kInterval_s, 0.4, odometer_cm(0.01 * i));
  EXPECT_NEAR(sum_m, 1.0, 0.011);
  EXPECT_EQ(travel.restarts(), 1);
}

TEST(WheelTravel, WhatWasRolledUnheardIsCaughtUp) {
  WheelTravel travel(2.0);
  travel.add(0.0, 0.5, 100);
  EXPECT_NEAR(travel.add(2.0, 0.5, 150), 0.5, 0.011);
  EXPECT_EQ(travel.restarts(), 0);
}

WheelOdometry::Options options() { return {kTrack_m, 2.0, 0.01, 0.05, 0.0}; }

/// Drives `speed` and `yaw_rate` for `duration_s` at exact speeds; returns the true pose.
Pose drive(WheelOdometry& odometry, double speed, double yaw_rate, double duration_s) {
  const WheelSpeeds wheels = wheel_speeds({speed, yaw_rate}, kTrack_m);
  Pose truth;
  WheelSpeeds rolled{0.0, 0.0};
  odometry.add(0.0, {wheels, 0, 0, std::nullopt});
  const int steps = static_cast<int>(std::lround(duration_s / kInterval_s));
  for (int i = 1; i <= steps; ++i) {
    truth = advanced(truth, {speed * kInterval_s, yaw_rate * kInterval_s});
    rolled = {rolled.left + wheels.left * kInterval_s, rolled.right + wheels.right * kInterval_s};
    odometry.add(kInterval_s * i,
                 {wheels, odometer_cm(rolled.left), odometer_cm(rolled.right), std::nullopt});
  }
  return truth;
}

TEST(WheelOdometry, FollowsCircles) {
  for (const double yaw_rate : {0.0, 0.7, -1.3}) {
    for (const double speed : {0.5, -0.4, 0.0}) {
      WheelOdometry odometry(options());
      const Pose truth = drive(odometry, speed, yaw_rate, 20.0);
      EXPECT_NEAR((odometry.pose().position - truth.position).norm(), 0.0, 0.05);
      EXPECT_NEAR(wrap_angle(odometry.pose().yaw_rad - truth.yaw_rad), 0.0, 0.03);
    }
  }
}

TEST(WheelOdometry, TheCovarianceGrowsWithDistanceAndTurning) {
  WheelOdometry still(options());
  drive(still, 0.0, 0.0, 10.0);
  WheelOdometry straight(options());
  drive(straight, 0.5, 0.0, 20.0);
  WheelOdometry turned(options());
  drive(turned, 0.0, 1.0, 20.0);
  const auto at_rest = still.covariance();
  EXPECT_GT(at_rest(0, 0), 0.0);
  EXPECT_NEAR(straight.covariance()(0, 0) - at_rest(0, 0), 1e-4 * 10.0, 1e-5);
  EXPECT_NEAR(turned.covariance()(2, 2) - at_rest(2, 2), 2.5e-3 * 20.0, 1e-3);
  for (const auto* odometry : {&still, &straight, &turned}) {
    const Eigen::Matrix3d c = odometry->covariance();
    EXPECT_TRUE(c.isApprox(c.transpose()));
    EXPECT_GT(c.eigenvalues().real().minCoeff(), 0.0);
  }
}

TEST(WheelOdometry, AHeadingInDoubtMakesThePlaceAcrossDoubtful) {
  WheelOdometry odometry(options());
  drive(odometry, 0.0, 1.0, 2.0 * 3.14159);
  const double before = odometry.covariance()(1, 1);
  double t = 100.0;
  odometry.add(t, {{0.0, 0.0}, -54, 54, std::nullopt});
  for (int cm = 1; cm <= 400; ++cm)
    odometry.add(t += kInterval_s, {{0.4, 0.4}, -54 + cm, 54 + cm, std::nullopt});
  EXPECT_GT(odometry.covariance()(1, 1), before + 0.01);
}

/// A base that turns on the spot with wheels that skid: they roll for half as much again as the
/// base turns. Its gyroscope has a bias.
class SkiddingBase {
 public:
  explicit SkiddingBase(WheelOdometry& odometry) : odometry_(odometry) {}

  void turn(double yaw_rate, double duration_s) {
    for (double t = 0.0; t < duration_s - 1e-9; t += kInterval_s) {
      yaw_rad += yaw_rate * kInterval_s;
      const double rim = 1.5 * yaw_rate * 0.5 * kTrack_m;
      rolled_m_ += rim * kInterval_s;
      odometry_.add(stamp_s_ += kInterval_s,
                    {{-rim, rim},
                     odometer_cm(-rolled_m_),
                     odometer_cm(rolled_m_),
                     yaw_rate + bias + 0.004 * std::normal_distribution<double>()(random_)});
    }
  }

  double bias = 0.03;
  double yaw_rad = 0.0;

 private:
  WheelOdometry& odometry_;
  double stamp_s_ = 0.0;
  double rolled_m_ = 0.0;
  std::mt19937 random_{9};
};

WheelOdometry odometry_with_gyro() { return WheelOdometry({kTrack_m, 2.0, 0.02, 0.05, 0.003}); }

TEST(WheelOdometry, AGyroscopeTellsHowFarSkiddingWheelsTurn) {
  WheelOdometry odometry = odometry_with_gyro();
  SkiddingBase base(odometry);
  base.turn(0.0, 3.0);
  const double before = odometry.covariance()(2, 2);
  for (int i = 0; i < 10; ++i) {
    base.turn(i % 3 == 0 ? -1.0 : 1.2, 2.0);
    base.turn(0.0, 2.0);
  }
  EXPECT_NEAR(wrap_angle(odometry.pose().yaw_rad - base.yaw_rad), 0.0, 0.05);
  const double sigma = std::sqrt(odometry.covariance()(2, 2) - before);
  EXPECT_GT(sigma, 0.005);
  EXPECT_LT(sigma, 0.03);
}

/// So slowly that most readings of the wheels are without a pulse.
TEST(WheelOdometry, ASlowTurnIsNoBias) {
  WheelOdometry odometry = odometry_with_gyro();
  double stamp_s = 0.0;
  for (int i = 0; i < 120; ++i) odometry.add(stamp_s += kInterval_s, {{0.0, 0.0}, 0, 0, 0.03});
  for (int i = 0; i < 400; ++i)
    odometry.add(stamp_s += kInterval_s, {{0.0, 0.0}, 0, 0, 0.03 + 0.08, true});
  EXPECT_NEAR(odometry.pose().yaw_rad, 0.08 * 400 * kInterval_s, 0.01);
}

TEST(WheelOdometry, TheBiasIsFollowed) {
  WheelOdometry odometry = odometry_with_gyro();
  SkiddingBase base(odometry);
  for (int minute = 0; minute < 10; ++minute) {
    base.bias = 0.02 + 0.002 * minute;
    base.turn(0.0, 40.0);
    base.turn(0.5, 20.0);
  }
  EXPECT_NEAR(wrap_angle(odometry.pose().yaw_rad - base.yaw_rad), 0.0, 0.1);
  ASSERT_TRUE(odometry.gyro_yaw_rate());
  EXPECT_NEAR(*odometry.gyro_yaw_rate(), 0.5, 0.03);
}

TEST(WheelOdometry, BeforeTheBiasIsKnownTheWheelsTellTheHeading) {
  WheelOdometry odometry = odometry_with_gyro();
  SkiddingBase base(odometry);
  base.turn(0.8, 3.0);
  EXPECT_FALSE(odometry.gyro_yaw_rate());
  EXPECT_NEAR(odometry.pose().yaw_rad, wrap_angle(1.5 * base.yaw_rad), 0.15);
}

TEST(WheelOdometry, AStandingRobotTurnedByHandTeachesNoBias) {
  WheelOdometry odometry = odometry_with_gyro();
  SkiddingBase base(odometry);
  base.turn(0.0, 3.0);
  for (int i = 0; i < 200; ++i) {
    odometry.add(10.0 + kInterval_s * i, {{0.0, 0.0}, 0, 0, 1.5});
  }
  odometry.add(20.0, {{0.0, 0.0}, 0, 0, 0.03});
  ASSERT_TRUE(odometry.gyro_yaw_rate());
  EXPECT_NEAR(*odometry.gyro_yaw_rate(), 0.0, 0.003);
}

}  // namespace
}  // namespace mocha
