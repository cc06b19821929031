// A robot of 0.6 m drives through doors, by what its lidar sees of them.
#include <gtest/gtest.h>

#include "benchmarks/leaving_run.h"

namespace mocha {
namespace {

constexpr double kMiddle_m = 0.5;  // of the doorway, where it lies on the cells of the map
constexpr double kBegin_m = 3.0;   // of the wall with the door
constexpr double kEnd_m = 3.2;

Polygon box(const Vector2& low, const Vector2& high) {
  return Polygon{{low, {high.x(), low.y()}, high, {low.x(), high.y()}}};
}

/// Two rooms; the door between them is `width_m` wide, and moved by `shift_m` off the cells.
World rooms_with_door(double width_m, double shift_m) {
  const double low_m = kMiddle_m + shift_m - 0.5 * width_m;
  World world;
  world.bounds = {Vector2(-1.0, -2.0), Vector2(7.0, 3.0)};
  world.polygons = {
      box({-1.0, -2.0}, {7.0, -1.9}),         box({-1.0, 2.9}, {7.0, 3.0}),
      box({-1.0, -1.9}, {-0.9, 2.9}),         box({6.9, -1.9}, {7.0, 2.9}),
      box({kBegin_m, -1.9}, {kEnd_m, low_m}), box({kBegin_m, low_m + width_m}, {kEnd_m, 2.9})};
  world.robots.push_back(
      {"ugv1", load_robot_model("config", "rover"), {{0.0, 0.3}, 0.0}, Goal{{6.0, kMiddle_m}, {}}});
  return world;
}

TEST(Doors, ThatAreWideEnoughArePassedWhereverTheyAre) {
  for (const double width_m : {0.9, 0.8, 0.75}) {
    for (const double shift_m : {0.0, 0.007, 0.013, 0.02}) {
      const LeavingRun run = run_leaving(rooms_with_door(width_m, shift_m), 1);
      EXPECT_TRUE(run.arrived) << width_m << " m, moved by " << shift_m << ": " << run.words;
      EXPECT_FALSE(run.contact) << width_m << " m, moved by " << shift_m;
      EXPECT_GT(run.clearance_m, 0.5 * (width_m - 0.6) - 0.035) << width_m << ", " << shift_m;
    }
  }
}

TEST(Doors, ThatAreTooNarrowAreNamedAndLeftAlone) {
  const LeavingRun run = run_leaving(rooms_with_door(0.65, 0.0), 1);
  EXPECT_FALSE(run.arrived);
  EXPECT_FALSE(run.left_s) << "it stays where it is";
  EXPECT_NE(run.words.find("the narrowest place of the widest way is (3."), std::string::npos)
      << run.words;
  // From 3 m away, hits are centimetres apart.
  EXPECT_NE(run.words.find(" m wide there, and the robot needs 0.69 m"), std::string::npos)
      << run.words;
}

}  // namespace
}  // namespace mocha
