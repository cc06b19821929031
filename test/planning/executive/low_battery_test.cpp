#include "planning/executive/low_battery.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

namespace mocha {
namespace {

using News = LowBattery::News;

constexpr double kPeriod_s = 0.1;

LowBattery::Options options() { return {Goal{{1.0, 2.0}, 0.5}, 9.6, 11.4, 5.0}; }

/// A robot that hears its voltage ten times a second.
struct Robot {
  LowBattery battery{options()};
  double now_s = 100.0;
  bool idle = false;
  bool stopped = false;

  /// The news that came, but for "none"; the last where there were several.
  News run(double duration_s, double voltage) {
    News last = News::kNone;
    for (const double end_s = now_s + duration_s; now_s < end_s - 1e-9; now_s += kPeriod_s) {
      battery.hear(now_s, voltage);
      const News news = battery.step(now_s, idle, stopped);
      if (news != News::kNone) last = news;
      if (news == News::kLow) idle = true;
      if (news == News::kGo) idle = false;
    }
    return last;
  }
};

TEST(LowBattery, ASagUnderLoadIsNotLow) {
  Robot robot;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(robot.run(4.0, 9.0), News::kNone);
    EXPECT_EQ(robot.run(0.2, 9.7), News::kNone);
  }
  EXPECT_EQ(robot.battery.reason(), "");
}

TEST(LowBattery, GivesUpItsGoalsAndGoesToBeCharged) {
  Robot robot;
  EXPECT_EQ(robot.run(4.9, 9.5), News::kNone);
  while (!robot.battery.low()) ASSERT_NE(robot.run(kPeriod_s, 9.5), News::kGo);
  EXPECT_LT(robot.now_s, 105.3);
  EXPECT_TRUE(robot.idle);  // as it has given its goals up
  EXPECT_NE(robot.battery.reason().find("9.50 V"), std::string::npos) << robot.battery.reason();
  EXPECT_EQ(robot.run(kPeriod_s, 9.5), News::kGo);
  EXPECT_EQ(robot.battery.goal().position, Vector2(1.0, 2.0));
  EXPECT_EQ(robot.run(600.0, 9.5), News::kNone);  // it is on its way
}

TEST(LowBattery, IsLowUntilItIsChargedForAWhile) {
  Robot robot;
  robot.run(6.0, 9.5);
  robot.battery.arrive();
  robot.idle = true;
  EXPECT_EQ(robot.run(600.0, 11.3), News::kNone);
  EXPECT_EQ(robot.run(4.0, 11.5), News::kNone);
  EXPECT_EQ(robot.run(1.0, 11.3), News::kNone);
  EXPECT_NE(robot.battery.reason(), "");
  EXPECT_EQ(robot.run(5.2, 11.5), News::kCharged);
  EXPECT_EQ(robot.battery.reason(), "");
  EXPECT_EQ(robot.run(6.0, 9.5), News::kGo);  // and so the next time
}

TEST(LowBattery, TriesAgainWhereItDidNotArrive) {
  Robot robot;
  robot.run(6.0, 9.5);
  robot.idle = true;  // it gave up
  EXPECT_EQ(robot.run(28.0, 9.5), News::kNone);
  EXPECT_EQ(robot.run(3.0, 9.5), News::kGo);
  robot.battery.arrive();
  robot.idle = true;
  EXPECT_EQ(robot.run(600.0, 9.5), News::kNone);
}

TEST(LowBattery, StaysAfterAnEmergencyStopUntilItIsToGoOn) {
  for (const bool before : {false, true}) {
    Robot robot;
    robot.stopped = before;
    EXPECT_EQ(robot.run(6.0, 9.5), before ? News::kLow : News::kGo);
    robot.stopped = true;
    robot.idle = true;
    EXPECT_EQ(robot.run(60.0, 9.5), News::kNone);
    robot.stopped = false;
    EXPECT_EQ(robot.run(60.0, 9.5), News::kNone);
    robot.battery.go_on();
    EXPECT_EQ(robot.run(1.0, 9.5), News::kGo);
  }
}

TEST(LowBattery, WhatIsNotMeasuredSaysNothing) {
  Robot robot;
  EXPECT_EQ(robot.run(60.0, std::nan("")), News::kNone);
  robot.run(4.0, 9.5);
  robot.now_s = 1.0;  // the clock is set back
  EXPECT_EQ(robot.run(4.5, 9.5), News::kNone);
  EXPECT_EQ(robot.run(1.0, 9.5), News::kGo);
}

TEST(LowBattery, IsNotHeededWithoutAPlaceToGo) {
  Robot robot;
  LowBattery::Options without = options();
  without.goal.reset();
  robot.battery = LowBattery(without);
  EXPECT_EQ(robot.run(60.0, 5.0), News::kNone);
  EXPECT_FALSE(robot.battery.low());
}

TEST(LowBattery, ReadsItsOptions) {
  const auto read = [](const std::string& yaml) {
    ParameterTable values = ParameterTable::from_schema("config/global_planner.yaml");
    values.assign(YAML::Load(yaml), "the test");
    return LowBattery::Options::from(values, 9.6);
  };
  EXPECT_FALSE(read("{}").goal);
  const auto place = read("low_battery_goal: '[1.5, -2]'");
  EXPECT_EQ(place.goal->position, Vector2(1.5, -2.0));
  EXPECT_FALSE(place.goal->yaw_rad);
  EXPECT_EQ(read("low_battery_goal: '[1, 2, -0.5]'").goal->yaw_rad, -0.5);
  for (const char* bad : {"'[1]'", "'[1, 2, 3, 4]'", "home", "'[1, .nan]'", "'{x: 1}'"}) {
    EXPECT_THROW(read(std::string("low_battery_goal: ") + bad), ParameterError) << bad;
  }
  EXPECT_THROW(read("{low_battery_goal: '[1, 2]', charged_battery: 9.6}"), ParameterError);
}

}  // namespace
}  // namespace mocha
