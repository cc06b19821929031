#include "planning/global/front_end.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planning/worlds.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

class FrontEndTest : public ::testing::Test {
 protected:
  /// Two metres to the left of a post, or of a wall with a gap on either side, to two on its right.
  FrontEndTest() {
    fill_box(grid_, {-0.2, -1.0}, {0.2, 1.0});
    query_.committed = standing(-1.0, {-2.0, 0.0}, 0.0);
  }
  GlobalSeeds seeds() const { return front_end_.seeds(query_, {static_map_of(grid_), {}}, kGoal); }

  inline static const Vector2 kGoal{2.0, 0.0};
  const RobotModel robot_ = rover();
  const PlannerOptions options_ = default_options();
  const FrontEnd front_end_{robot_, options_};
  OccupancyGrid grid_ = free_grid({-5.0, -4.0}, {5.0, 4.0});
  PlanQuery query_;
};

TEST_F(FrontEndTest, FindsASeedOnEitherSideWithWhatItCostsAtLeast) {
  const GlobalSeeds found = seeds();
  ASSERT_GE(found.list.size(), 2u);
  EXPECT_NE(found.list[0].signature, found.list[1].signature);
  for (const Seed& seed : found.list) {
    ASSERT_FALSE(seed.start_maneuvers.empty());
    EXPECT_EQ(seed.start_maneuvers[0].path.back(), kGoal);
    EXPECT_FALSE(seed.driven);
    // From rest to rest over four metres, straight.
    const MotionLimits& limits = robot_.limits;
    EXPECT_GE(seed.least_cost,
              options_.weight_duration *
                  (4.0 / limits.max_speed + limits.max_speed / limits.max_acceleration));
    EXPECT_LT(seed.least_cost, options_.weight_duration * 15.0);
  }
}

TEST_F(FrontEndTest, SaysThatAPathIsOneOfTheLattice) {
  fill_box(grid_, {-0.2, -4.0}, {0.2, 4.0});
  fill_box(grid_, {-0.2, 1.5}, {0.2, 2.4}, OccupancyGrid::kFree);
  ASSERT_FALSE(seeds().list.empty());
  for (const Seed& seed : seeds().list) EXPECT_FALSE(seed.fallback);
  PlannerOptions few = options_;
  few.roadmap = RoadmapKind::kVisibilityPrm;
  few.prm_samples = 1;
  const GlobalSeeds found = FrontEnd(robot_, few).seeds(query_, {static_map_of(grid_), {}}, kGoal);
  ASSERT_EQ(found.list.size(), 1u);
  ASSERT_TRUE(found.list[0].fallback);
  EXPECT_EQ(found.list[0].fallback->kind, FallbackKind::kLatticePath);
  EXPECT_LT((found.list[0].fallback->place - Vector2(0.0, 1.95)).norm(), 0.4) << "in the gap";
}

TEST_F(FrontEndTest, GivesUpBeforeTheSearchOnlyWhereNothingCanLead) {
  const Vector2 start(-2.0, 0.0);
  const auto may_reach = [&] { return front_end_.may_reach(start, kGoal, *static_map_of(grid_)); };
  EXPECT_TRUE(may_reach());
  fill_box(grid_, {-0.2, -4.0}, {0.2, 4.0});
  EXPECT_FALSE(may_reach());
  // From a tight place, a way out may be tighter than paths are.
  fill_box(grid_, {-2.5, 0.2}, {-1.5, 0.6});
  EXPECT_TRUE(may_reach());
}

TEST_F(FrontEndTest, KnowsTheClassThatIsBeingDriven) {
  const GlobalSeeds fresh = seeds();
  const std::vector<Vector2>& path = fresh.list[1].start_maneuvers[0].path;
  std::vector<Phase> phases;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 step = path[i] - path[i - 1];
    const double yaw_rad = std::atan2(step.y(), step.x());
    const Pose from{path[i - 1], phases.empty() ? 0.0 : Motion(0.0, phases).end_pose().yaw_rad};
    if (const auto turn = turn_in_place(from, yaw_rad, robot_.limits)) phases.emplace_back(*turn);
    const Motion leg = straight_drive(0.0, path[i - 1], yaw_rad, step.norm(), 0.5, 0.5);
    phases.insert(phases.end(), leg.phases().begin(), leg.phases().end());
  }
  query_.driven = Motion(0.0, std::move(phases));
  const GlobalSeeds found = seeds();
  ASSERT_TRUE(found.driven);
  int driven = 0;
  for (const Seed& seed : found.list) {
    EXPECT_EQ(seed.driven, seed.signature == *found.driven);
    driven += seed.driven;
  }
  EXPECT_EQ(driven, 1);
  const GlobalSeeds promising = front_end_.promising(query_, {static_map_of(grid_), {}}, kGoal);
  ASSERT_FALSE(promising.list.empty());
  EXPECT_LT(promising.list.size(), found.list.size());
  EXPECT_TRUE(std::any_of(promising.list.begin(), promising.list.end(),
                          [](const Seed& seed) { return seed.driven; }));
}

TEST_F(FrontEndTest, NothingIsPromisingWhileNothingIsDriven) {
  EXPECT_TRUE(front_end_.promising(query_, {static_map_of(grid_), {}}, kGoal).list.empty());
}

TEST_F(FrontEndTest, BrakesFirstWhereThePathTurnsAway) {
  query_.committed = straight_drive(-2.0, {-1.6, 0.0}, M_PI, 3.0, 0.8, 0.8);
  const double speed = query_.committed.at(0.0).speed;
  ASSERT_GT(speed, 0.5);
  const GlobalSeeds found = seeds();
  ASSERT_FALSE(found.list.empty());
  for (const Seed& seed : found.list) {
    ASSERT_GE(seed.start_maneuvers[0].phases.size(), 2u) << "it brakes and turns";
    EXPECT_TRUE(seed.start_maneuvers[0].state.col(1).isZero());
  }
  query_.committed = standing(-1.0, {-2.0, 0.0}, 0.0);
  EXPECT_TRUE(front_end_.after_braking(query_, {static_map_of(grid_), {}}, kGoal).list.empty());
}

TEST_F(FrontEndTest, ReachesWhatIsNotWalledIn) {
  const auto go_on = [] { return false; };
  EXPECT_TRUE(front_end_.reaches({-2.0, 0.0}, kGoal, *static_map_of(grid_), go_on));
  fill_box(grid_, {-0.2, -4.0}, {0.2, 4.0});
  EXPECT_FALSE(front_end_.reaches({-2.0, 0.0}, kGoal, *static_map_of(grid_), go_on));
  EXPECT_TRUE(seeds().list.empty());
}

// --- along a given path ---

TEST_F(FrontEndTest, AlongAPathThereIsOneSeed) {
  const std::vector<Vector2> along = {{-2.0, 0.0}, {-2.0, 3.0}, {2.0, 3.0}, kGoal};
  query_.along = along;
  const GlobalSeeds found = seeds();
  ASSERT_EQ(found.list.size(), 1u);
  ASSERT_FALSE(found.list[0].start_maneuvers.empty());
  for (const StartManeuver& start : found.list[0].start_maneuvers)
    EXPECT_EQ(start.path, along) << "not by the shortest way";
  EXPECT_FALSE(found.driven);
}

TEST_F(FrontEndTest, AlongAPathItBeginsWhereTheRobotIsOnIt) {
  query_.along = {{-4.0, 0.0}, {-3.0, 0.0}, {-1.0, 0.0}, {0.0, 2.0}, kGoal};
  query_.committed = standing(-1.0, {-2.0, 0.05}, 0.0);
  const GlobalSeeds found = seeds();
  ASSERT_EQ(found.list.size(), 1u);
  const std::vector<Vector2> rest = {{-2.0, 0.05}, {-1.0, 0.0}, {0.0, 2.0}, kGoal};
  EXPECT_EQ(found.list[0].start_maneuvers.at(0).path, rest);
}

TEST_F(FrontEndTest, AlongAPathItComesByTheWayThatItHasPromised) {
  query_.committed = straight_drive(-2.0, {-3.0, 0.0}, 0.0, 3.0, 0.8, 0.8);
  query_.start_time_s = 0.0;
  query_.along = {{0.0, 0.0}, {0.0, 3.0}};
  const GlobalSeeds found = seeds();
  ASSERT_EQ(found.list.size(), 1u);
  const std::vector<Vector2>& path = found.list[0].start_maneuvers.at(0).path;
  double nearest_m = 1e9;
  for (const Vector2& place : path) nearest_m = std::min(nearest_m, place.norm());
  EXPECT_LT(nearest_m, 0.05) << "not straight to its end";
  EXPECT_EQ(path.back(), Vector2(0.0, 3.0));
}

TEST_F(FrontEndTest, AlongAPathOfWhichNothingIsLeftItGoesToItsEnd) {
  query_.along = {{-4.0, 0.0}, {-3.0, 0.0}};
  const GlobalSeeds found = seeds();
  ASSERT_EQ(found.list.size(), 1u);
  EXPECT_EQ(found.list[0].start_maneuvers.at(0).path.back(), Vector2(-3.0, 0.0));
}

TEST_F(FrontEndTest, AlongAPathItBrakesFirstWhereThatTurnsAway) {
  query_.along = {{-2.0, 0.0}, {-2.0, 3.0}, {2.0, 3.0}, kGoal};
  query_.committed = straight_drive(-2.0, {-1.6, 0.0}, M_PI, 3.0, 0.8, 0.8);
  const GlobalSeeds found = seeds();
  ASSERT_EQ(found.list.size(), 1u);
  const StartManeuver& start = found.list[0].start_maneuvers.at(0);
  EXPECT_GE(start.phases.size(), 2u) << "it brakes and turns";
  const std::vector<Vector2> rest = {{-2.0, 3.0}, {2.0, 3.0}, kGoal};
  ASSERT_EQ(start.path.size(), 4u);
  EXPECT_TRUE(std::equal(rest.begin(), rest.end(), start.path.begin() + 1));
}

TEST_F(FrontEndTest, AlongAPathThatTurnsBackItComesToRestFirst) {
  query_.committed = straight_drive(-2.0, {-3.0, 0.0}, 0.0, 3.0, 0.8, 0.8);
  query_.start_time_s = 0.0;
  query_.along = {{0.0, 0.0}, {-1.0, 0.3}, {-1.0, 3.0}};
  const GlobalSeeds found = seeds();
  ASSERT_EQ(found.list.size(), 1u);
  const StartManeuver& start = found.list[0].start_maneuvers.at(0);
  EXPECT_NEAR(start.duration_s, query_.committed.end_time(), 1e-6) << "as it has promised";
  EXPECT_EQ(start.direction, -1);
  EXPECT_TRUE(start.state.col(1).isZero());
  EXPECT_EQ(start.path, query_.along);
}

/// Under way, and while it waits before it sets off.
TEST_F(FrontEndTest, AlongAPathBackTheWayItComesItComesToRestFirst) {
  const Motion drives = straight_drive(-2.0, {-3.0, 0.0}, 0.0, 3.0, 0.8, 0.8);
  const StandPhase stands{{{-3.0, 0.0}, 0.0}, 2.0};
  query_.start_time_s = 0.0;
  query_.along = {{0.0, 0.0}, {-3.0, 0.0}};
  for (const Motion& committed : {drives, Motion(-1.0, {stands, drives.phases().front()})}) {
    query_.committed = committed;
    const GlobalSeeds found = seeds();
    ASSERT_EQ(found.list.size(), 1u);
    const StartManeuver& start = found.list[0].start_maneuvers.at(0);
    EXPECT_NEAR(start.duration_s, committed.end_time(), 1e-6) << "as it has promised";
    EXPECT_EQ(start.direction, -1);
    EXPECT_EQ(start.path, query_.along);
  }
}

TEST_F(FrontEndTest, AlongAPathWhoStandsThereChangesNothing) {
  query_.along = {{-2.0, 0.0}, {-2.0, 3.0}, {2.0, 3.0}, kGoal};
  PlanningScene scene{static_map_of(grid_), {}};
  scene.peers = {std::make_shared<PeerObstacle>(
      "ugv7", std::make_shared<const Motion>(standing(-5.0, {0.0, 3.0}, 0.0)), 0.3,
      test::kRoverBraking)};
  const GlobalSeeds found = front_end_.seeds(query_, scene, kGoal);
  ASSERT_EQ(found.list.size(), 1u);
  EXPECT_EQ(found.list[0].start_maneuvers.at(0).path, query_.along);
}

}  // namespace
}  // namespace mocha
