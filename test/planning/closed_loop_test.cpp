#include "planning/closed_loop.h"

#include <gtest/gtest.h>

#include "topology/shipped_options.h"
#include "trajectory/rover_braking.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

class ReplannerLoop : public ::testing::Test {
 protected:
  const RobotModel robot_ = rover();
  const SpeedMargin margin_ = MarginBudget::of(robot_).static_margin();
  const OccupancyGrid open_ = free_grid({-2.0, -3.0}, {12.0, 3.0});

  static OccupancyGrid with_pillars() {
    OccupancyGrid grid = free_grid({-2.0, -3.0}, {12.0, 3.0});
    for (double x = 2.0; x < 8.0; x += 2.0)
      fill_disc(grid, {x, x == 4.0 ? 0.4 : -0.4}, 0.4, OccupancyGrid::kOccupied);
    return grid;
  }

  void expect_sound(const ClosedLoop& loop) const {
    EXPECT_GE(loop.least_spare_m, -1e-3);
    EXPECT_EQ(loop.steps_without_lease, 0);
    EXPECT_LT(loop.largest_jump_m, 0.01);
    EXPECT_EQ(loop.emergencies, 0);
  }
};

TEST_F(ReplannerLoop, ReachesItsGoal) {
  ClosedLoop loop(robot_, with_pillars(), {0.0, 0.0}, {9.0, 0.0});
  EXPECT_TRUE(loop.run_to_goal(25.0)) << loop.output.message;
  expect_sound(loop);
  EXPECT_LE(loop.plans, 3);  // the first plan is good to the end
  EXPECT_GT(loop.proposals, 5);
  EXPECT_LT(loop.proposals, 25);
}

TEST_F(ReplannerLoop, ReachesItsGoalThoughProposalsAreTurnedDown) {
  ClosedLoop loop(robot_, with_pillars(), {0.0, 0.0}, {9.0, 0.0});
  loop.peers().refused_share = 0.5;
  EXPECT_TRUE(loop.run_to_goal(60.0)) << loop.output.message;
  expect_sound(loop);
}

TEST_F(ReplannerLoop, ReachesItsGoalThoughPlanningIsSlow) {
  ClosedLoop loop(robot_, with_pillars(), {0.0, 0.0}, {9.0, 0.0});
  loop.planning_takes_s = 1.5;  // three times what is planned ahead
  EXPECT_TRUE(loop.run_to_goal(40.0)) << loop.output.message;
  expect_sound(loop);
}

TEST_F(ReplannerLoop, StandsWhenNobodyAnswers) {
  ClosedLoop loop(robot_, open_, {0.0, 0.0}, {9.0, 0.0});
  loop.run(4.0);
  ASSERT_FALSE(loop.standing());
  loop.peers().answers = false;
  loop.run(8.0);  // the horizon and braking
  EXPECT_TRUE(loop.standing());
  expect_sound(loop);
  loop.peers().answers = true;
  EXPECT_TRUE(loop.run_to_goal(25.0)) << loop.output.message;
}

TEST_F(ReplannerLoop, SwervesAroundAnObstacleThatAppears) {
  ClosedLoop loop(robot_, open_, {0.0, 0.0}, {9.0, 0.0});
  loop.run(5.0);
  const double x = loop.state().pose.position.x();
  ASSERT_GT(x, 1.0);
  fill_disc(loop.world, {x + 2.2, 0.1}, 0.4, OccupancyGrid::kOccupied);
  loop.step();
  ASSERT_TRUE(loop.output.local);
  EXPECT_EQ(loop.output.local->reason, PlanReason::kSolved);
  EXPECT_TRUE(loop.run_to_goal(15.0)) << loop.output.message;
  EXPECT_GE(loop.least_spare_m, -robot_.margins.map_m - 1e-3);
  EXPECT_EQ(loop.steps_without_lease, 0);
}

TEST_F(ReplannerLoop, StopsBeforeAWallThatAppearsAndGoesOnWhenItIsGone) {
  ClosedLoop loop(robot_, open_, {0.0, 0.0}, {9.0, 0.0});
  loop.run(5.0);
  const double x = loop.state().pose.position.x() + 2.5;
  fill_box(loop.world, {x, -3.0}, {x + 0.3, 3.0});
  // Open beyond the map: close that, too.
  fill_box(loop.world, {-2.0, 2.8}, {12.0, 3.0});
  fill_box(loop.world, {-2.0, -3.0}, {12.0, -2.8});
  loop.run(10.0);
  EXPECT_TRUE(loop.standing());
  EXPECT_LT(loop.state().pose.position.x(), x - 0.3 - margin_.still_m + 1e-3);
  EXPECT_GE(loop.least_spare_m, -1e-3);
  EXPECT_GT(loop.reasons[PlanReason::kBraking], 0);
  loop.world = open_;
  EXPECT_TRUE(loop.run_to_goal(40.0)) << loop.output.message;
}

TEST_F(ReplannerLoop, DrivesIntoUnseenSpaceOnlyAsFarAsItHasSeen) {
  ClosedLoop loop(robot_, with_pillars(), {0.0, 0.0}, {9.0, 0.0});
  OccupancyGrid seen = loop.world;
  std::fill(seen.cells.begin(), seen.cells.end(), OccupancyGrid::kUnknown);
  loop.see = [&loop, seen, this](const Vector2& here) mutable {
    for (int y = 0; y < seen.height; ++y) {
      for (int x = 0; x < seen.width; ++x) {
        if ((seen.cell_centre(x, y) - here).norm() < 2.5) seen.at(x, y) = loop.world.at(x, y);
      }
    }
    // Nothing promised may reach what has not been seen.
    if (!loop.committed().empty()) {
      const DistanceField unseen(seen, DistanceField::Solid::kOccupiedOrUnknown);
      EXPECT_GE(unseen.distance_bound(loop.committed().end_pose().position),
                0.3 + margin_.still_m - 1e-3);
    }
    return seen;
  };
  EXPECT_TRUE(loop.run_to_goal(60.0)) << loop.output.message;
  EXPECT_GE(loop.least_spare_m, -robot_.margins.map_m - 1e-3);
  EXPECT_EQ(loop.steps_without_lease, 0);
  EXPECT_LT(loop.largest_jump_m, 0.01);
}

TEST_F(ReplannerLoop, BlindItStopsAtTheFrontier) {
  ClosedLoop loop(robot_, open_, {0.0, 0.0}, {9.0, 0.0});
  OccupancyGrid seen = open_;
  fill_box(seen, {5.0, -3.0}, {12.0, 3.0}, OccupancyGrid::kUnknown);
  loop.see = [seen](const Vector2&) { return seen; };
  loop.run(20.0);
  EXPECT_TRUE(loop.standing());
  EXPECT_LT(loop.state().pose.position.x(), 5.0 - 0.3 - margin_.still_m + 1e-3);
  EXPECT_GT(loop.state().pose.position.x(), 5.0 - 0.3 - 0.3);
  EXPECT_LT(loop.proposals, 15);  // while it waits it says nothing new
  expect_sound(loop);
}

TEST_F(ReplannerLoop, KidnappedItStopsWhereItIsAndGoesOnFromThere) {
  ClosedLoop loop(robot_, open_, {0.0, 0.0}, {9.0, 0.0});
  loop.run(5.0);
  loop.kidnapped = {0.0, 0.25};
  loop.step();
  EXPECT_EQ(loop.output.reason, PlanReason::kBraking);
  ASSERT_TRUE(loop.output.proposal);
  EXPECT_TRUE(loop.output.proposal->emergency);
  const Vector2 begins = loop.output.proposal->motion.at(loop.now_s).pose.position;
  EXPECT_LT((begins - loop.state().pose.position).norm(), 1e-5);
  loop.kidnapped.setZero();  // the new motion starts where it really is
  EXPECT_TRUE(loop.run_to_goal(40.0)) << loop.output.message;
}

TEST_F(ReplannerLoop, LetsAPeerCross) {
  ClosedLoop loop(robot_, open_, {0.0, 0.0}, {9.0, 0.0});
  loop.run(2.0);
  const auto crossing = std::make_shared<const Motion>(
      straight_drive(loop.now_s + 1.0, {4.5, -2.5}, M_PI / 2.0, 5.0, 0.9, 0.5));
  loop.others = {std::make_shared<PeerObstacle>("ugv2", crossing, 0.3, test::kRoverBraking)};
  double least_m = 1e9;
  for (int i = 0; i < 400; ++i) {
    loop.step();
    least_m = std::min(
        least_m, (loop.state().pose.position - crossing->at(loop.now_s).pose.position).norm());
    if ((loop.state().pose.position - loop.goal).norm() < 0.15 && loop.standing()) break;
  }
  EXPECT_LT((loop.state().pose.position - loop.goal).norm(), 0.15);
  EXPECT_GE(least_m, 0.6 + robot_.peer_clearance_m);
  EXPECT_EQ(loop.steps_without_lease, 0);
}

TEST_F(ReplannerLoop, RandomWorldsAreDrivenToTheEnd) {
  int paths = 0;
  for (int seed = 1; seed <= 12; ++seed) {
    const Vector2 start(0.6, 0.6);
    const Vector2 goal(7.4, 5.4);
    const OccupancyGrid grid = random_world(seed, 24, start, goal, 0.6);
    TravelOptions front_end = shipped_travel_options();
    front_end.required_clearance_m = 0.3 + margin_.at(robot_.limits.max_speed) + 0.01;
    if (find_path_on_grid(occupied_field(grid), start, goal, {}, front_end).outcome !=
        GridPath::Outcome::kFound)
      continue;
    ++paths;
    OccupancyGrid wide = grown_to_hold(grid, {start, goal}, 3.0);
    std::replace(wide.cells.begin(), wide.cells.end(), OccupancyGrid::kUnknown,
                 OccupancyGrid::kFree);
    ClosedLoop loop(robot_, wide, start, goal);
    loop.peers().refused_share = 0.1;
    const bool reached = loop.run_to_goal(90.0);
    EXPECT_TRUE(reached) << seed << ": " << loop.output.message;
    EXPECT_GE(loop.least_spare_m, -robot_.margins.map_m - 1e-3) << seed;
    EXPECT_EQ(loop.steps_without_lease, 0) << seed;
  }
  EXPECT_GT(paths, 6);
}

}  // namespace
}  // namespace mocha
