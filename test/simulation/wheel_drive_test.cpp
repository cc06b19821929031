#include "simulation/wheel_drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mocha {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kLag_s = 0.1;

/// A wheel with the inertia of its robot.
struct Wheel {
  WheelDrive drive{WheelDrive::Options()};
  double now_s = 0.0;
  double speed = 0.0;
  double rolled_m = 0.0;

  void step(double heading) {
    const double before = speed;
    speed += (1.0 - std::exp(-kStep_s / kLag_s)) * (heading - speed);
    if (std::abs(heading - speed) < 1e-6) speed = heading;
    const double rolled = 0.5 * kStep_s * (before + speed);
    rolled_m += rolled;
    now_s += kStep_s;
    drive.roll(rolled, speed);
  }
};

/// How a wheel turns in 20 s, from standing.
struct Course {
  double mean = 0.0;     ///< [m/s]
  double fastest = 0.0;  ///< [m/s]
  int stalls = 0;        ///< times that it came to stand
};

Course course(const std::function<double(Wheel&)>& heading) {
  constexpr double kDuration_s = 20.0;
  Wheel wheel;
  Course result;
  bool stood = true;
  while (wheel.now_s < kDuration_s) {
    wheel.step(heading(wheel));
    const bool stands = std::abs(wheel.speed) < 0.01;
    result.stalls += stands && !stood;
    result.fastest = std::max(result.fastest, wheel.speed);
    stood = stands;
  }
  result.mean = wheel.rolled_m / kDuration_s;
  return result;
}

Course by_speed(double wanted) {
  return course([=](Wheel& wheel) { return wheel.drive.follow_speed(wheel.now_s, wanted); });
}

Course by_pwm(double pwm) {
  return course([=](Wheel& wheel) { return wheel.drive.follow_pwm(pwm); });
}

TEST(WheelDrive, StallsLeapsAndStallsAgainAtLowSpeed) {
  for (const double wanted : {0.05, 0.075, 0.1}) {
    const Course wheel = by_speed(wanted);
    EXPECT_GE(wheel.stalls, 10) << wanted;
    EXPECT_GT(wheel.fastest, 3.0 * wanted) << wanted;
    EXPECT_NEAR(wheel.mean, wanted, 0.3 * wanted) << wanted;
  }
}

TEST(WheelDrive, KeepsRollingAtSpeed) {
  for (const double wanted : {0.3, 0.6}) {
    const Course wheel = by_speed(wanted);
    EXPECT_EQ(wheel.stalls, 0) << wanted;
    EXPECT_NEAR(wheel.mean, wanted, 0.05 * wanted) << wanted;
  }
}

TEST(WheelDrive, TurnsEvenlyByPwmBeyondItsFriction) {
  EXPECT_EQ(by_pwm(45.0).fastest, 0.0);
  const Course wheel = by_pwm(46.0);
  EXPECT_EQ(wheel.stalls, 0);
  EXPECT_NEAR(wheel.fastest, 1.3 / 220.0 * 11.0, 1e-6);
}

TEST(WheelDrive, RollsOnBelowWhatSetsItOffButNotBelowItsFriction) {
  Wheel wheel;
  for (int i = 0; i < 100; ++i) wheel.step(wheel.drive.follow_pwm(60.0));
  for (int i = 0; i < 200; ++i) wheel.step(wheel.drive.follow_pwm(40.0));
  EXPECT_NEAR(wheel.speed, 1.3 / 220.0 * 5.0, 1e-6);
  for (int i = 0; i < 200; ++i) wheel.step(wheel.drive.follow_pwm(35.0));
  EXPECT_LT(wheel.speed, 1e-6);
}

TEST(WheelDrive, ReadsItsSpeedInWholePulses) {
  constexpr double kQuantum = M_PI * 0.08 / 660.0 / 0.001;  // [m/s]
  Wheel wheel;
  double sum = 0.0;
  for (int i = 0; i < 2000; ++i) {
    wheel.speed = 0.1;
    wheel.step(0.1);
    const double read = wheel.drive.measured_speed();
    EXPECT_NEAR(read, kQuantum * std::round(read / kQuantum), 1e-12);
    sum += read;
  }
  EXPECT_NEAR(sum / 2000, 0.1, 0.02);
}

/// Turned by hand against the order to stand: the sum that has wound up meanwhile sets it off.
TEST(WheelDrive, ItsSumOutlivesAStop) {
  Wheel held;
  for (int i = 0; i < 30; ++i) {
    held.drive.follow_speed(held.now_s, 0.2);
    held.now_s += kStep_s;
  }
  for (int i = 0; i < 300; ++i) held.step(held.drive.follow_speed(held.now_s, 0.0));
  EXPECT_EQ(held.rolled_m, 0.0);
  held.now_s += 0.1;
  EXPECT_GT(held.drive.follow_speed(held.now_s, 0.001), 0.0);  // at once
  Wheel fresh;
  fresh.now_s += 0.1;
  EXPECT_EQ(fresh.drive.follow_speed(fresh.now_s, 0.001), 0.0);
}

}  // namespace
}  // namespace mocha
