#include "base/wheel_control.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kPeriod_s = 0.025;
constexpr double kLag_s = 0.1;
const WheelControl::Options kOptions{170.0, 35.0, 50.0, 0.14};

/// A wheel of 0.1 s lag, under control, whose readings are exact.
struct Wheel {
  double breakaway_pwm = 45.0;
  double friction_pwm = 35.0;
  double pwm_per_speed = 170.0;
  WheelControl control{kOptions};
  double speed = 0.0;
  double rolled_m = 0.0;
  double pwm = 0.0;

  void run(double duration_s, double wanted) {
    for (double t_s = 0.0; t_s < duration_s - 1e-9; t_s += kPeriod_s) {
      pwm = control.pwm(kPeriod_s, wanted);
      const double holding = std::abs(speed) < 0.005 ? breakaway_pwm : friction_pwm;
      const double free = std::max(0.0, std::abs(pwm) - friction_pwm);
      const double heading =
          std::abs(pwm) > holding ? std::copysign(free / pwm_per_speed, pwm) : 0.0;
      speed += (1.0 - std::exp(-kPeriod_s / kLag_s)) * (heading - speed);
      rolled_m += speed * kPeriod_s;
      control.measure({kPeriod_s, speed * kPeriod_s, std::abs(speed) > 0.005});
    }
  }
};

TEST(WheelControl, HoldsASpeedWhateverTheMotorTakesForIt) {
  for (const double pwm_per_speed : {140.0, 170.0, 200.0}) {
    for (const double wanted : {0.1, 0.5, -0.5}) {
      Wheel wheel;
      wheel.pwm_per_speed = pwm_per_speed;
      wheel.run(2.0, wanted);
      const double from_m = wheel.rolled_m;
      wheel.run(4.0, wanted);
      EXPECT_NEAR(wheel.rolled_m - from_m, 4.0 * wanted, 0.02) << pwm_per_speed << " " << wanted;
    }
  }
}

TEST(WheelControl, SetsOffWithWhatBreaksAWheelLoose) {
  WheelControl control(kOptions);
  EXPECT_NEAR(control.pwm(0.02, 0.1), 50.0 + 17.0, 1e-9);
  control.measure({kPeriod_s, 0.0, true});
  EXPECT_LT(control.pwm(0.02, 0.1), 50.0 + 17.0);
  for (int i = 0; i < 10; ++i) control.measure({kPeriod_s, 0.0, false});  // it stalls
  EXPECT_GE(control.pwm(0.02, 0.1), 50.0 + 17.0);
}

TEST(WheelControl, CreepsAtTheRightSpeedInSteps) {
  Wheel wheel;
  int starts = 0;
  bool stood = true;
  for (int i = 0; i < 800; ++i) {
    wheel.run(kPeriod_s, 0.01);
    starts += stood && wheel.pwm != 0.0;
    stood = wheel.pwm == 0.0;
  }
  EXPECT_NEAR(wheel.rolled_m, 0.2, 0.03);
  EXPECT_GE(starts, 5);
}

TEST(WheelControl, WhatGoesToAndFroDoesNotMoveAWheel) {
  Wheel wheel;
  for (int i = 0; i < 200; ++i) wheel.run(0.05, i % 2 == 0 ? 0.02 : -0.02);
  EXPECT_EQ(wheel.rolled_m, 0.0);
}

TEST(WheelControl, DoesNotWindUpWhereAWheelIsHeld) {
  Wheel wheel;
  wheel.breakaway_pwm = 255.0;
  wheel.run(60.0, 0.3);
  EXPECT_LT(wheel.pwm, 50.0 + 170.0 * (0.3 + 0.13));
  wheel.breakaway_pwm = 45.0;
  const double from_m = wheel.rolled_m;
  wheel.run(2.0, 0.3);
  EXPECT_LT(wheel.rolled_m - from_m, 0.6 + 0.05);
}

TEST(WheelControl, ToldToStandItGivesNothing) {
  Wheel wheel;
  wheel.run(1.0, 0.5);
  EXPECT_EQ(wheel.control.pwm(0.02, 0.0), 0.0);
}

TEST(WheelControl, RefusesAWheelThatSetsOffWithLessThanItRolls) {
  ParameterTable values = ParameterTable::from_schema("config/base_driver.yaml");
  const RobotModel model = load_robot_model("config", "waveshare_rover");
  EXPECT_NO_THROW(WheelControl::Options::from(values, model));
  values.assign(YAML::Load("{friction_pwm: 40.0, breakaway_pwm: 30.0}"), "the test");
  EXPECT_THROW(WheelControl::Options::from(values, model), ParameterError);
}

}  // namespace
}  // namespace mocha
