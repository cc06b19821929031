#include "planning/maneuvers/escape_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planning/maneuver_test.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class EscapeSearchTest : public ManeuverTest, public ::testing::WithParamInterface<const char*> {
 protected:
  EscapeSearchTest() : ManeuverTest(GetParam()) {}

  LocalScene with(const std::vector<std::pair<Vector2, Vector2>>& people) const {
    LocalScene scene = scene_of(open_);
    for (const auto& [place, velocity] : people)
      scene.confident.push_back(person(kNow_s, place, velocity));
    scene.predicted_until_s = kNow_s + 5.0;
    return scene;
  }

  /// Between the bodies, at its least.
  double least_gap_m(const Motion& motion, const LocalScene& scene) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (double t = motion.start_time(); t < motion.end_time(); t += 0.01) {
      for (const auto& thing : scene.confident) {
        const auto disc = thing->at(t);
        least_m = std::min(least_m, (motion.position(t) - disc.centre).norm() - disc.radius_m -
                                        robot_.footprint.circumscribed_radius_m());
      }
    }
    return least_m;
  }

  const OccupancyGrid open_ = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const double speed_ = 0.9 * robot_.limits.max_speed;
  const Motion ahead_ = straight_drive(kNow_s - 2.0, {-2.0 * speed_, 0.0}, 0.0, 14.0, speed_,
                                       0.5 * robot_.limits.max_acceleration);
};

TEST_P(EscapeSearchTest, GoesOnFromTheMotionToRest) {
  const Vector2 here = ahead_.position(kNow_s);
  const LocalScene scene = with({{here + Vector2(3.0, 0.0), {-0.8, 0.0}}});
  const ManeuverStart start = start_of(ahead_, scene, kNow_s);
  const Maneuvers found = escape_searches(start);
  ASSERT_EQ(found.size(), 1u);
  const Motion& motion = found[0].motion;
  const MotionState leaves = ahead_.at(start.emergency_s);
  const MotionState begins = motion.at(start.emergency_s + 1e-6);
  EXPECT_TRUE(found[0].at_once);
  EXPECT_EQ(motion.start_time(), start.emergency_s);
  EXPECT_LT((begins.pose.position - leaves.pose.position).norm(), 1e-4);
  EXPECT_LT((begins.velocity - leaves.velocity).norm(), 1e-3);
  EXPECT_TRUE(motion.at(motion.end_time() + 0.1).at_rest);
  EXPECT_GT(least_gap_m(motion, scene), 0.05);
}

TEST_P(EscapeSearchTest, FindsTheGapInARowThatComes) {
  // A row of people abreast comes towards the robot; one place is missing.
  const Vector2 here = ahead_.position(kNow_s);
  std::vector<std::pair<Vector2, Vector2>> row;
  const double apart_m = 2.0 * robot_.footprint.circumscribed_radius_m() + 0.75;
  for (int i = -4; i <= 4; ++i) {
    if (i != 1) row.push_back({here + Vector2(4.0, 0.6 * apart_m * i), {-0.8, 0.0}});
  }
  const LocalScene scene = with(row);
  const Maneuvers found = escape_searches(start_of(ahead_, scene, kNow_s));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(least_gap_m(found[0].motion, scene), 0.0);
}

TEST_P(EscapeSearchTest, FromRestItTurnsFirst) {
  // Somebody comes from ahead, others stand there to either side.
  const Motion stands = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  const LocalScene scene =
      with({{{3.0, 0.0}, {-0.8, 0.0}}, {{1.2, 1.2}, {0.0, 0.0}}, {{1.2, -1.2}, {0.0, 0.0}}});
  const Maneuvers found = escape_searches(start_of(stands, scene, kNow_s));
  ASSERT_EQ(found.size(), 1u);
  const Motion& motion = found[0].motion;
  EXPECT_TRUE(std::holds_alternative<TurnPhase>(motion.phases().front()));
  EXPECT_GT(least_gap_m(motion, scene), 0.0);
  EXPECT_LT((motion.position(motion.start_time()) - stands.end_pose().position).norm(), 1e-9);
}

TEST_P(EscapeSearchTest, KeepsFromWalls) {
  // A corridor with somebody in its middle: on one side of him is room.
  OccupancyGrid corridor = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const Vector2 here = ahead_.position(kNow_s);
  const double wide_m = 2.0 * robot_.footprint.circumscribed_radius_m() + 0.9;
  fill_box(corridor, {-8.0, -8.0}, {12.0, here.y() - wide_m});
  fill_box(corridor, {-8.0, here.y() + wide_m}, {12.0, 8.0});
  LocalScene scene = scene_of(corridor);
  scene.confident = {person(kNow_s, here + Vector2(3.0, -0.4), {-0.6, 0.0})};
  scene.predicted_until_s = kNow_s + 5.0;
  const Maneuvers found = escape_searches(start_of(ahead_, scene, kNow_s));
  ASSERT_FALSE(found.empty());
  for (const Maneuver& maneuver : found) {
    const Motion& motion = maneuver.motion;
    for (double t = motion.start_time(); t < motion.end_time(); t += 0.05) {
      EXPECT_GT(scene.obstacles->distance_bound(motion.position(t)),
                robot_.footprint.circumscribed_radius_m() - 0.05);
    }
  }
}

TEST_P(EscapeSearchTest, IsNoneNearAPeer) {
  const LocalScene open = with({});
  EXPECT_FALSE(escape_searches(start_of(ahead_, open, kNow_s)).empty());
  for (const auto& [apart_m, is_near] : {std::pair{4.0, true}, std::pair{9.0, false}}) {
    LocalScene scene = open;
    const Vector2 place = ahead_.position(kNow_s) + Vector2(0.0, apart_m);
    scene.peers = {peer(standing(kNow_s - 9.0, place, 0.0))};
    EXPECT_EQ(escape_searches(start_of(ahead_, scene, kNow_s)).empty(), is_near);
  }
}

TEST_P(EscapeSearchTest, IsNoneDrivingBackward) {
  Motion back = Motion(ahead_.start_time(), ahead_.phases());
  auto drive = std::get<DrivePhase>(back.phases().front());
  drive.direction = -1;
  const Motion backward(ahead_.start_time(), {drive});
  const LocalScene open = with({});
  EXPECT_TRUE(escape_searches(start_of(backward, open, kNow_s)).empty());
}

INSTANTIATE_TEST_SUITE_P(Robots, EscapeSearchTest, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
