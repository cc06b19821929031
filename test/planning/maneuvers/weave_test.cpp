#include "planning/maneuvers/weave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planning/maneuver_test.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class WeaveTest : public ManeuverTest, public ::testing::WithParamInterface<const char*> {
 protected:
  WeaveTest() : ManeuverTest(GetParam()) {}

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

  const OccupancyGrid open_ = free_grid({-8.0, -8.0}, {16.0, 8.0});
  const double speed_ = 0.9 * robot_.limits.max_speed;
  const Motion ahead_ = straight_drive(kNow_s - 2.0, {-2.0 * speed_, 0.0}, 0.0, 14.0, speed_,
                                       0.5 * robot_.limits.max_acceleration);
  const Motion slow_ = straight_drive(kNow_s - 2.0, {-0.8 * speed_, 0.0}, 0.0, 14.0, 0.5 * speed_,
                                      0.25 * robot_.limits.max_acceleration);
};

TEST_P(WeaveTest, GoesOnFromTheMotionToRest) {
  const Vector2 here = ahead_.position(kNow_s);
  const LocalScene scene = with({{here + Vector2(3.0, 0.0), {-0.8, 0.0}}});
  const ManeuverStart start = start_of(ahead_, scene, kNow_s);
  const Maneuvers found = ways_out(start);
  ASSERT_FALSE(found.empty());
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

TEST_P(WeaveTest, FindsTheGapInARowThatComes) {
  // A row of people abreast comes towards the robot; one place is missing.
  const Vector2 here = ahead_.position(kNow_s);
  std::vector<std::pair<Vector2, Vector2>> row;
  const double apart_m = 2.0 * robot_.footprint.circumscribed_radius_m() + 0.75;
  for (int i = -4; i <= 4; ++i) {
    if (i != 1) row.push_back({here + Vector2(4.0, 0.6 * apart_m * i), {-0.8, 0.0}});
  }
  const LocalScene scene = with(row);
  const Maneuvers found = ways_out(start_of(ahead_, scene, kNow_s));
  ASSERT_FALSE(found.empty());
  EXPECT_GT(least_gap_m(found[0].motion, scene), 0.0);
}

TEST_P(WeaveTest, FromRestItTurnsFirst) {
  // Somebody comes from ahead, others stand there side by side.
  const Motion stands = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  const LocalScene scene =
      with({{{3.0, 0.0}, {-0.8, 0.0}}, {{0.9, 0.5}, {0.0, 0.0}}, {{0.9, -0.5}, {0.0, 0.0}}});
  const Maneuvers found = ways_out(start_of(stands, scene, kNow_s));
  ASSERT_FALSE(found.empty());
  const Motion& motion = found[0].motion;
  EXPECT_TRUE(std::holds_alternative<TurnPhase>(motion.phases().front()));
  EXPECT_GT(least_gap_m(motion, scene), 0.0);
  EXPECT_LT((motion.position(motion.start_time()) - stands.end_pose().position).norm(), 1e-9);
}

TEST_P(WeaveTest, KeepsFromWalls) {
  // A corridor with somebody in its middle: on one side of him is room.
  OccupancyGrid corridor = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const Vector2 here = ahead_.position(kNow_s);
  const double wide_m = 2.0 * robot_.footprint.circumscribed_radius_m() + 0.9;
  fill_box(corridor, {-8.0, -8.0}, {12.0, here.y() - wide_m});
  fill_box(corridor, {-8.0, here.y() + wide_m}, {12.0, 8.0});
  LocalScene scene = scene_of(corridor);
  scene.confident = {person(kNow_s, here + Vector2(3.0, -0.4), {-0.6, 0.0})};
  scene.predicted_until_s = kNow_s + 5.0;
  const Maneuvers found = ways_out(start_of(ahead_, scene, kNow_s));
  ASSERT_FALSE(found.empty());
  for (const Maneuver& maneuver : found) {
    const Motion& motion = maneuver.motion;
    for (double t = motion.start_time(); t < motion.end_time(); t += 0.05) {
      EXPECT_GT(scene.obstacles->distance_bound(motion.position(t)),
                robot_.footprint.circumscribed_radius_m() - 0.05);
    }
  }
}

TEST_P(WeaveTest, GoesOnTowardsTheTargetWithinTheUsualLimits) {
  // Somebody stands in the way, and somebody else walks towards one side of him.
  const Vector2 here = slow_.position(kNow_s);
  const LocalScene scene =
      with({{here + Vector2(4.0, 0.0), {0.0, 0.0}}, {here + Vector2(8.0, 2.0), {-1.0, 0.0}}});
  ManeuverStart start = start_of(slow_, scene, kNow_s);
  start.target = here + Vector2(12.0, 0.0);
  const auto choice = first_certified(start, weaves(start), RequirementName::kPromise);
  ASSERT_TRUE(choice);
  EXPECT_GT(choice->motion.end_pose().position.x(), here.x() + 1.8 * robot_.limits.max_speed);
  EXPECT_GT(least_gap_m(choice->motion, scene), robot_.moving_clearance_m);
}

TEST_P(WeaveTest, KeepsFromUnseenSpace) {
  OccupancyGrid grid = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const Vector2 here = ahead_.position(kNow_s);
  fill_box(grid, {here.x() + 3.0, -8.0}, {12.0, 8.0}, OccupancyGrid::kUnknown);
  LocalScene scene = scene_of(grid);
  scene.predicted_until_s = kNow_s + 5.0;
  const Maneuvers found = weaves(start_of(ahead_, scene, kNow_s));
  for (const Maneuver& maneuver : found)
    EXPECT_LT(maneuver.motion.end_pose().position.x(), here.x() + 3.0);
}

TEST_P(WeaveTest, WhereSomebodyIsTooNearAlreadyItLeaves) {
  const Motion stands = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  const double apart_m =
      robot_.footprint.circumscribed_radius_m() + 0.25 + 0.5 * robot_.moving_clearance_m;
  const LocalScene scene = with({{{0.0, apart_m}, {0.0, 0.0}}});
  ManeuverStart start = start_of(stands, scene, kNow_s);
  start.target = {9.0, -4.0};
  const Maneuvers found = weaves(start);
  ASSERT_FALSE(found.empty());
  EXPECT_GT(least_gap_m(found[0].motion, scene), 0.5 * robot_.moving_clearance_m - 0.05);
}

TEST_P(WeaveTest, DoesNotEndWhereSomebodyComesSoon) {
  // People stand in a row, and others walk along it: the robot cannot stay in their way.
  const Vector2 here = ahead_.position(kNow_s);
  std::vector<std::pair<Vector2, Vector2>> people;
  for (int i = -8; i <= 8; ++i) people.push_back({here + Vector2(5.0, 0.9 * i), {0.0, 0.0}});
  for (int i = 0; i < 4; ++i) people.push_back({here + Vector2(3.5, 3.0 + 2.2 * i), {0.0, -1.0}});
  const LocalScene scene = with(people);
  for (const Maneuver& maneuver : weaves(start_of(ahead_, scene, kNow_s))) {
    const Vector2 end = maneuver.motion.end_pose().position;
    for (double t = maneuver.motion.end_time(); t < maneuver.motion.end_time() + 1.4; t += 0.1) {
      for (const auto& thing : scene.confident) {
        const auto disc = thing->at(t);
        EXPECT_GT((disc.centre - end).norm() - disc.radius_m,
                  robot_.footprint.circumscribed_radius_m());
      }
    }
  }
}

TEST_P(WeaveTest, BindsAtOnceUnlessAPeerIsNear) {
  LocalScene scene = with({});
  EXPECT_TRUE(weaves(start_of(ahead_, scene, kNow_s)).at(0).at_once);
  const Vector2 place = ahead_.position(kNow_s) + Vector2(0.0, 4.0);
  scene.peers = {peer(standing(kNow_s - 9.0, place, 0.0))};
  const ManeuverStart start = start_of(ahead_, scene, kNow_s);
  const Maneuver settled = weaves(start).at(0);
  EXPECT_FALSE(settled.at_once);
  EXPECT_EQ(settled.join_s, start.settled_s);
}

TEST_P(WeaveTest, IsNoneNearAPeer) {
  const LocalScene open = with({});
  EXPECT_FALSE(ways_out(start_of(ahead_, open, kNow_s)).empty());
  for (const auto& [apart_m, is_near] : {std::pair{4.0, true}, std::pair{9.0, false}}) {
    LocalScene scene = open;
    const Vector2 place = ahead_.position(kNow_s) + Vector2(0.0, apart_m);
    scene.peers = {peer(standing(kNow_s - 9.0, place, 0.0))};
    EXPECT_EQ(ways_out(start_of(ahead_, scene, kNow_s)).empty(), is_near);
  }
}

TEST_P(WeaveTest, IsNoneDrivingBackward) {
  Motion back = Motion(ahead_.start_time(), ahead_.phases());
  auto drive = std::get<DrivePhase>(back.phases().front());
  drive.direction = -1;
  const Motion backward(ahead_.start_time(), {drive});
  const LocalScene open = with({});
  EXPECT_TRUE(ways_out(start_of(backward, open, kNow_s)).empty());
}

INSTANTIATE_TEST_SUITE_P(Robots, WeaveTest, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
