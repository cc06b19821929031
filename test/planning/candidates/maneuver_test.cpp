#include "planning/candidates/maneuver.h"

#include <gtest/gtest.h>

#include "planning/maneuver_test.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

TEST_F(ManeuverTest, TheWholeOfAMotionIsNotCut) {
  const Motion ahead = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 4.0, 0.9, 0.5);
  const Maneuver maneuver = whole(ahead, kNow_s, true, "goes");
  EXPECT_GT(maneuver.brake_from_s, ahead.end_time());
  EXPECT_GT(maneuver.brake_until_s, ahead.end_time());
  EXPECT_LT(maneuver.least_reach_s, kNow_s);
  EXPECT_TRUE(maneuver.at_once);
  EXPECT_EQ(maneuver.follows, Follows::kNothing);
  // Where all of it is not certified, no part of it is promised either.
  OccupancyGrid grid = free_grid({-2.0, -2.0}, {8.0, 2.0});
  const LocalScene open = scene_of(grid);
  fill_box(grid, {3.5, -2.0}, {8.0, 2.0});
  const LocalScene walled = scene_of(grid);
  const Motion stands = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  const auto part = [&](const LocalScene& scene) {
    return certified_part(start_of(stands, scene, kNow_s - 0.3), maneuver,
                          RequirementName::kPromise);
  };
  ASSERT_TRUE(part(open));
  EXPECT_NEAR(part(open)->motion.end_time(), ahead.end_time(), 1e-5);
  EXPECT_FALSE(part(walled));
}

TEST_F(ManeuverTest, ARobotIsAloneWhereNoPeerIsNearNow) {
  const OccupancyGrid grid = free_grid({-2.0, -2.0}, {8.0, 2.0});
  const Motion ahead = straight_drive(kNow_s - 3.0, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  LocalScene scene = scene_of(grid);
  EXPECT_TRUE(is_alone(start_of(ahead, scene, kNow_s)));
  scene.confident = {person(kNow_s, ahead.position(kNow_s), {0.0, 0.0})};
  EXPECT_TRUE(is_alone(start_of(ahead, scene, kNow_s))) << "people hear of no promise";
  for (const auto& [apart_m, alone] : {std::pair{4.9, false}, std::pair{5.1, true}}) {
    const Vector2 place = ahead.position(kNow_s) + Vector2(0.0, apart_m);
    scene.peers = {peer(standing(kNow_s - 9.0, {50.0, 0.0}, 0.0)),
                   peer(standing(kNow_s - 9.0, place, 0.0))};
    EXPECT_EQ(is_alone(start_of(ahead, scene, kNow_s)), alone);
  }
  // It comes near only later.
  scene.peers = {peer(straight_drive(kNow_s, {1.0, -6.0}, M_PI / 2.0, 6.0, 0.9, 0.5))};
  EXPECT_TRUE(is_alone(start_of(ahead, scene, kNow_s)));
}

}  // namespace
}  // namespace mocha
