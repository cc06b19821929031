#include "planning/maneuvers/sidestep.h"

#include <gtest/gtest.h>

#include <tuple>

#include "planning/candidates/exposure.h"
#include "planning/maneuver_test.h"
#include "trajectory/random_motion.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class SidestepTest : public ManeuverTest, public ::testing::WithParamInterface<const char*> {
 protected:
  SidestepTest() : ManeuverTest(GetParam()) {}

  LocalScene with(const OccupancyGrid& grid, const Vector2& centre, const Vector2& velocity) const {
    LocalScene scene = scene_of(grid);
    scene.confident = {person(kNow_s, centre, velocity)};
    scene.predicted_until_s = kNow_s + 5.0;
    return scene;
  }
  std::vector<Motion> steps(const Motion& committed, const LocalScene& scene,
                            double now_s = kNow_s) const {
    std::vector<Motion> motions;
    for (Maneuver& each : sidesteps(start_of(committed, scene, now_s)))
      motions.push_back(std::move(each.motion));
    return motions;
  }
  /// To what is asked of a promise, for good.
  double room_m(const Motion& motion, const LocalScene& scene) const {
    return least_room_m(
        motion, foreseen(kept_apart(scene, requirements_[RequirementName::kPromise].from(kNow_s))),
        kNow_s, kNow_s + 5.0);
  }
  Motion winding(int seed) const {
    return within(random_drive(seed, 8),
                  {0.9 * robot_.limits.max_speed, 0.7 * robot_.limits.max_acceleration,
                   0.7 * robot_.limits.max_yaw_rate},
                  kNow_s);
  }
  static void expect_joins(const Maneuver& maneuver, const Motion& committed) {
    const MotionState leaves = committed.at(maneuver.join_s);
    const MotionState begins = maneuver.motion.at(maneuver.join_s + 1e-6);
    EXPECT_EQ(maneuver.motion.start_time(), maneuver.join_s);
    EXPECT_LT((begins.pose.position - leaves.pose.position).norm(), 1e-4);
    EXPECT_LT((begins.velocity - leaves.velocity).norm(), 1e-3);
    EXPECT_LT(std::abs(wrap_angle(begins.pose.yaw_rad - leaves.pose.yaw_rad)), 1e-3);
    EXPECT_TRUE(maneuver.motion.at(maneuver.motion.end_time() + 0.1).at_rest);
  }

  const double required_m_ =
      robot_.footprint.circumscribed_radius_m() + MarginBudget::of(robot_).static_margin_m();
  const OccupancyGrid open_ = free_grid({-6.0, -6.0}, {6.0, 6.0});
  const Motion stands_ = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
};

TEST_P(SidestepTest, EachKeepsTheLimitsAndGoesOnFromTheMotionToRest) {
  const LocalScene empty = scene_of(open_);
  for (int seed = 0; seed < 10; ++seed) {
    const Motion committed = winding(seed);
    for (const double now_s : {kNow_s - 1.0, kNow_s + 0.7, kNow_s + 2.0, kNow_s + 90.0}) {
      const ManeuverStart start = start_of(committed, empty, now_s);
      const Maneuvers found = sidesteps(start);
      EXPECT_LE(found.size(), 10u);
      // Within the map, there is room to step to.
      const bool has_room = committed.position(start.settled_s).cwiseAbs().maxCoeff() < 3.0;
      EXPECT_TRUE(!found.empty() || !has_room) << seed;
      for (const Maneuver& maneuver : found) {
        EXPECT_EQ(maneuver.join_s, start.settled_s);
        EXPECT_FALSE(maneuver.at_once);
        const Violation violation = check_limits(maneuver.motion, robot_.limits, maneuver.join_s);
        EXPECT_FALSE(violation) << seed << ": " << describe(violation);
        expect_joins(maneuver, committed);
      }
    }
  }
}

TEST_P(SidestepTest, HardOnesKeepTheLimitsOfAnEmergency) {
  const LocalScene empty = scene_of(open_);
  int at_once = 0;
  int kept = 0;
  for (int seed = 0; seed < 10; ++seed) {
    const Motion committed = winding(seed);
    const ManeuverStart start = start_of(committed, empty, kNow_s + 2.0);
    for (const Maneuver& maneuver : hard_sidesteps(start)) {
      EXPECT_EQ(maneuver.join_s, maneuver.at_once ? start.emergency_s : start.settled_s);
      expect_joins(maneuver, committed);
      ++(maneuver.at_once ? at_once : kept);
      const Violation violation =
          check_limits(maneuver.motion, robot_.emergency_limits(), maneuver.join_s);
      EXPECT_FALSE(violation) << seed << ": " << describe(violation);
    }
  }
  EXPECT_GT(at_once, 50);
  EXPECT_GT(kept, 50);
}

TEST_P(SidestepTest, NearAPeerAllAreSettled) {
  LocalScene scene = scene_of(open_);
  scene.peers = {peer(standing(kNow_s - 9.0, {0.0, 4.0}, 0.0))};
  const Maneuvers found = hard_sidesteps(start_of(stands_, scene, kNow_s));
  ASSERT_FALSE(found.empty());
  for (const Maneuver& maneuver : found) EXPECT_FALSE(maneuver.at_once);
}

TEST_P(SidestepTest, StepsOutOfTheWayOfWhatComes) {
  for (int i = 0; i < 8; ++i) {
    const Vector2 course(std::cos(0.7 * i), std::sin(0.7 * i));
    const LocalScene scene = with(open_, -4.0 * course, 1.2 * course);
    ASSERT_LT(room_m(stands_, scene), 0.0);
    const auto found = steps(stands_, scene);
    ASSERT_FALSE(found.empty());
    EXPECT_GT(room_m(found.front(), scene), 0.0) << i;
  }
}

TEST_P(SidestepTest, OfTwoWithEnoughRoomTheSoonerDoneComesFirst) {
  const auto found = steps(stands_, with(open_, {40.0, 0.0}, {0.0, 0.0}));
  ASSERT_GT(found.size(), 1u);
  for (std::size_t i = 1; i < found.size(); ++i)
    EXPECT_LE(found[i - 1].end_time(), found[i].end_time());
  EXPECT_EQ(found.front().phases().size(), 2u);  // stands, and drives without a turn
}

TEST_P(SidestepTest, GoesBackwardWhereThatIsTheWay) {
  // What comes is ahead, and walls are on both sides.
  robot_.lidar.field_of_view_rad = 2.0 * M_PI;
  OccupancyGrid corridor = open_;
  fill_box(corridor, {-6.0, required_m_ + 0.1}, {6.0, 6.0});
  fill_box(corridor, {-6.0, -6.0}, {6.0, -required_m_ - 0.1});
  const LocalScene walls = with(corridor, {1.2, 0.0}, {-0.1, 0.0});
  const auto found = steps(stands_, walls);
  ASSERT_FALSE(found.empty());
  const auto& drive = std::get<DrivePhase>(found.front().phases().back());
  EXPECT_EQ(drive.direction, -1);
  EXPECT_LT(found.front().end_pose().position.x(), -0.3);
  EXPECT_NEAR(found.front().end_pose().yaw_rad, 0.0, 1e-6);
  for (const Motion& motion : found)
    EXPECT_FALSE(check_clearance(motion, robot_.footprint, *walls.obstacles, 0.0, kNow_s));
}

TEST_P(SidestepTest, OfARobotThatMustNotReverseAllTurnAndGoForward) {
  const LocalScene scene = with(open_, {1.2, 0.0}, {-0.1, 0.0});
  for (const auto& [can_reverse, sees_back, hard] : {std::tuple{false, true, false},
                                                     {false, true, true},
                                                     {true, false, false},
                                                     {true, false, true}}) {
    robot_.limits.can_reverse = can_reverse;
    robot_.lidar.field_of_view_rad = sees_back ? 2.0 * M_PI : 1.5 * M_PI;
    const ManeuverStart start = start_of(stands_, scene, kNow_s);
    const Maneuvers found = hard ? hard_sidesteps(start) : sidesteps(start);
    ASSERT_FALSE(found.empty());
    double least_x = 0.0;
    for (const Maneuver& each : found) {
      const Violation violation = check_limits(each.motion, robot_.emergency_limits(), kNow_s);
      EXPECT_FALSE(violation) << describe(violation);
      EXPECT_EQ(std::get<DrivePhase>(each.motion.phases().back()).direction, 1);
      least_x = std::min(least_x, each.motion.end_pose().position.x());
    }
    EXPECT_LT(least_x, -0.1) << "also to where the robot had its back";
  }
}

TEST_P(SidestepTest, StandsFreeAtTheEnd) {
  OccupancyGrid pillars = open_;
  for (int i = 0; i < 6; ++i)
    fill_disc(pillars, 1.6 * Vector2(std::cos(1.0 * i), std::sin(1.0 * i)), 0.3,
              OccupancyGrid::kOccupied);
  const LocalScene scene = with(pillars, {0.0, 3.0}, {0.0, -1.0});
  const auto found = steps(standing(kNow_s - 1.0, {0.0, 0.0}, 0.3), scene);
  ASSERT_FALSE(found.empty());
  for (const Motion& motion : found)
    EXPECT_GE(scene.obstacles->distance_bound(motion.end_pose().position), required_m_ - 1e-6);
}

TEST_P(SidestepTest, IsNoneWhereThereIsNoRoom) {
  OccupancyGrid cell = open_;
  fill_box(cell, {-6.0, -6.0}, {6.0, 6.0});
  fill_box(cell, {-required_m_, -required_m_}, {required_m_, required_m_}, OccupancyGrid::kFree);
  EXPECT_TRUE(steps(stands_, with(cell, {0.5, 0.0}, {-1.0, 0.0})).empty());
}

INSTANTIATE_TEST_SUITE_P(Robots, SidestepTest, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
