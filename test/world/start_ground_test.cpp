#include "world/start_ground.h"

#include <gtest/gtest.h>

#include "world/margin_budget.h"

namespace mocha {
namespace {

RobotModel jackal() { return load_robot_model("config", "jackal"); }

TEST(StartGround, HoldsTheBodyAndItsMargin) {
  const RobotModel robot = jackal();
  const double around_m = MarginBudget::of(robot).static_margin_m() + robot.map_resolution_m;
  const StartGround ground(robot);
  EXPECT_TRUE(ground.contains({0.0, 0.0}));
  EXPECT_TRUE(ground.contains({0.253, 0.0}));
  EXPECT_TRUE(ground.contains({0.254 + around_m - 0.001, 0.0}));
  EXPECT_FALSE(ground.contains({0.254 + around_m + 0.001, 0.0}));
  EXPECT_TRUE(ground.contains({0.0, 0.215 + around_m - 0.001}));
  EXPECT_FALSE(ground.contains({0.0, 0.215 + around_m + 0.001}));
}

TEST(StartGround, HoldsWhatItSweepsBehindItsLidar) {
  const StartGround ground(jackal());  // sees 135 degrees to either side
  const auto at = [&](double angle_deg, double distance_m) {
    const double angle_rad = angle_deg * M_PI / 180.0;
    return ground.contains(distance_m * Vector2(std::cos(angle_rad), std::sin(angle_rad)));
  };
  const double reach_m = ground.reach_m();
  EXPECT_TRUE(at(180.0, reach_m - 0.001));
  EXPECT_FALSE(at(180.0, reach_m + 0.001));
  EXPECT_TRUE(at(137.0, reach_m - 0.001));
  EXPECT_TRUE(at(-137.0, reach_m - 0.001));
  EXPECT_FALSE(at(90.0, reach_m - 0.001));
  EXPECT_FALSE(at(0.0, reach_m - 0.001));
}

TEST(StartGround, HoldsWhatIsTooNearForTheLidar) {
  RobotModel robot = jackal();
  robot.lidar.field_of_view_rad = 2.0 * M_PI;
  const Vector2 beside(0.0, 0.3);
  EXPECT_FALSE(StartGround(robot).contains(beside));
  robot.lidar.min_range_m = 0.31;
  EXPECT_TRUE(StartGround(robot).contains(beside));
}

TEST(StartGround, IsUnderTheBodyAloneForALidarThatSeesAllRound) {
  const RobotModel robot = load_robot_model("config", "rover");
  EXPECT_TRUE(robot.lidar.sees_all_round());
  EXPECT_TRUE(robot.lidar.sees({-1.0, 0.0})) << "where its last beam meets its first";
  const double beside_m = robot.footprint.circumscribed_radius_m() + 0.2;
  EXPECT_FALSE(StartGround(robot).contains({-beside_m, 0.0}));
}

TEST(StartGround, ItsPartUnderTheBodyHoldsNothingElse) {
  const StartGround part = StartGround(jackal()).under_body();
  EXPECT_TRUE(part.contains({-0.25, 0.0}));
  EXPECT_FALSE(part.contains({-0.5, 0.0}));
  EXPECT_LT(part.reach_m(), 0.6);
}

TEST(StartGround, SeesFromWhereTheLidarIs) {
  RobotModel robot = jackal();
  const Vector2 behind(-0.35, 0.0);
  EXPECT_TRUE(StartGround(robot).contains(behind));
  robot.lidar.mount = {{-0.1, 0.0}, M_PI};  // it looks back
  EXPECT_FALSE(StartGround(robot).contains(behind));
  EXPECT_TRUE(StartGround(robot).contains({0.35, 0.0}));
}

}  // namespace
}  // namespace mocha
