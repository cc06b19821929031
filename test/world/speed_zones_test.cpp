#include "world/speed_zones.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

constexpr double kSince_s = 1.7e9;

RobotModel rover() { return load_robot_model("config", "rover"); }

Zone square(double max_speed) {
  return {"slow", Polygon{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}}, max_speed};
}

TEST(SpeedZones, AreThoseThatAreSlowerThanTheRobot) {
  EXPECT_EQ(SpeedZones::of({}, rover(), kSince_s), nullptr);
  EXPECT_EQ(SpeedZones::of({square(0.0)}, rover(), kSince_s), nullptr);
  EXPECT_EQ(SpeedZones::of({square(10.0)}, rover(), kSince_s), nullptr);
  const auto zones = SpeedZones::of({square(0.0), square(0.3)}, rover(), kSince_s);
  ASSERT_NE(zones, nullptr);
  ASSERT_EQ(zones->areas().size(), 1u);
  EXPECT_EQ(zones->areas()[0].max_speed, 0.3);
}

TEST(SpeedZones, CountWhereAnyOfTheBodyMayBe) {
  const auto zones = SpeedZones::of({square(0.3)}, rover(), kSince_s);
  const double reach_m = rover().footprint.circumscribed_radius_m();
  EXPECT_EQ(zones->fastest_at({1.0, 1.0}), 0.3);
  EXPECT_EQ(zones->fastest_at({2.0 + 0.99 * reach_m, 1.0}), 0.3);
  EXPECT_EQ(zones->fastest_at({2.0 + 1.01 * reach_m, 1.0}), rover().limits.max_speed);
}

TEST(SpeedZones, TheLimitComesDownAsARobotBrakes) {
  const auto zones = SpeedZones::of({square(0.3)}, rover(), kSince_s);
  const auto& area = zones->areas()[0];
  const double max_speed = rover().limits.max_speed;
  EXPECT_EQ(zones->limit_at(area, kSince_s), max_speed);
  EXPECT_EQ(zones->limit_at(area, kSince_s + SpeedZones::kNotice_s), max_speed);
  const double t = kSince_s + SpeedZones::kNotice_s + 0.5;
  EXPECT_LT(zones->limit_at(area, t), max_speed);
  EXPECT_NEAR(zones->limit_at(area, t + 0.1) - zones->limit_at(area, t),
              0.1 * zones->limit_rate(area, t), 1e-6);
  EXPECT_LE(-zones->limit_rate(area, t), rover().braking().deceleration());
  EXPECT_EQ(zones->limit_at(area, kSince_s + 60.0), 0.3);
  EXPECT_EQ(zones->limit_rate(area, kSince_s + 60.0), 0.0);
}

}  // namespace
}  // namespace mocha
