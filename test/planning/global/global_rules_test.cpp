#include "planning/global/global_rules.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planning/global/global_planner.h"
#include "planning/worlds.h"
#include "topology/static_map/primitive_static_map.h"
#include "world/margin_budget.h"
#include "world/world_file.h"

namespace mocha {
namespace {

const std::function<bool()> kGoOn = [] { return false; };

struct Task {
  PlanningScene scene;
  RobotModel robot;
  PlanQuery query;
};

/// The first robot of a world file, standing at its start, knows its analytic obstacles.
Task task_of(const std::string& file) {
  const World world = load_world(file, "config");
  std::vector<Obstacle> obstacles(world.circles.begin(), world.circles.end());
  obstacles.insert(obstacles.end(), world.polygons.begin(), world.polygons.end());
  const auto field = std::make_shared<PrimitiveField<2>>(std::move(obstacles), 1.0);
  const WorldRobot& robot = world.robots.front();
  Task task{{std::make_shared<PrimitiveStaticMap>(field, world.bounds), {}}, robot.model, {}};
  task.query.committed = standing(-1.0, robot.start.position, robot.start.yaw_rad);
  task.query.goal = robot.goal->position;
  return task;
}

PlanResult plan(const Task& task, const PlannerOptions& options) {
  return GlobalPlanner(task.robot, options).plan(task.query, task.scene);
}

const PlanCandidate& selected(const PlanResult& result) {
  return *std::find_if(result.candidates.begin(), result.candidates.end(),
                       [](const PlanCandidate& candidate) { return candidate.selected; });
}

PlanCandidate candidate_of(const Task& task, const PlannerOptions& options, const Seed& seed) {
  const DriveOptimizer optimizer(task.robot, options, MarginBudget::of(task.robot).static_margin());
  const GlobalRules rules(task.robot, options, task.query, task.scene);
  return CandidatePipeline(optimizer, task.scene.static_map->field(), rules)
      .optimise_and_certify(seed, kGoOn);
}

TEST(Classes, ThePlanFromTheStraightLineIsTwentyPerCentDearerInTheSlalom) {
  const Task task = task_of("config/worlds/slalom.yaml");
  const PlannerOptions options = default_options();
  const PlanResult all = plan(task, options);
  ASSERT_EQ(all.reason, PlanReason::kSolved) << all.message;
  ASSERT_GE(all.candidates.size(), 4u);
  const Pose start = task.query.committed.end_pose();
  const StartManeuvers start_maneuvers(task.robot.limits, options.smooth_start_rad);
  const Seed line{
      start_maneuvers.from_rest({}, start, {start.position, task.query.goal}), {}, {}, 0.0, false};
  const PlanCandidate single = candidate_of(task, options, line);
  ASSERT_EQ(single.reason, PlanReason::kSolved) << describe(single.violation);
  EXPECT_GE(single.cost, 1.2 * selected(all).cost);
  EXPECT_GE(single.motion.end_time(), 1.2 * all.motion.end_time());
}

TEST(Classes, CostsAreSumsOfTheirTermsAndNoLessThanTheirBound) {
  const Task task = task_of("config/worlds/rooms.yaml");
  const PlannerOptions options = default_options();
  const GlobalSeeds seeds =
      FrontEnd(task.robot, options).seeds(task.query, task.scene, task.query.goal);
  ASSERT_GE(seeds.list.size(), 4u);
  for (const Seed& seed : seeds.list) {
    const PlanCandidate found = candidate_of(task, options, seed);
    ASSERT_EQ(found.reason, PlanReason::kSolved);
    double sum = 0.0;
    for (const auto& [name, value] : found.terms) sum += value;
    EXPECT_NEAR(found.cost, sum, 1e-6 * sum);
    EXPECT_GE(found.cost, seed.least_cost);
    EXPECT_GE(found.cost, options.weight_duration * found.motion.end_time());
  }
}

TEST(Classes, WhatCannotWinIsGivenUpWithoutChangingTheWinner) {
  const Task task = task_of("config/worlds/rooms.yaml");
  PlannerOptions options = default_options();
  options.classes = 10;
  int given_up = 0;
  Signature first;
  for (const int threads : {1, 2, 4}) {
    options.threads = threads;
    const PlanResult result = plan(task, options);
    ASSERT_EQ(result.reason, PlanReason::kSolved);
    const PlanCandidate& best = selected(result);
    if (threads == 1) first = best.signature;
    EXPECT_EQ(best.signature, first);
    for (const PlanCandidate& other : result.candidates) {
      EXPECT_GE(other.cost, best.cost);
      given_up += other.reason == PlanReason::kCannotWin;
    }
  }
  EXPECT_GT(given_up, 0);
}

/// Two boxes side by side across the way: through the middle, or round either.
class Hysteresis : public ::testing::Test {
 protected:
  /// The gap above the box is that much wider than the one below.
  PlanResult replan(double upper_m, const Motion& driven, double margin) const {
    OccupancyGrid grid = free_grid({-2.0, -6.0}, {12.0, 6.0});
    fill_box(grid, {4.0, -2.0 - upper_m}, {4.5, 2.0 - upper_m});
    PlannerOptions options = default_options();
    options.switch_margin = margin;
    PlanQuery query;
    query.committed = standing(-1.0, {0.0, 0.0}, 0.0);
    query.goal = {9.0, 0.0};
    query.driven = driven;
    return GlobalPlanner(rover(), options).plan(query, {static_map_of(grid), {}});
  }
};

TEST_F(Hysteresis, StaysOnItsSideUntilTheOtherOneIsCheaperByTheMargin) {
  const PlanResult below = replan(-0.3, Motion(), 0.15);
  ASSERT_EQ(below.reason, PlanReason::kSolved) << below.message;
  EXPECT_FALSE(below.switches_class);
  const auto side = [](const PlanResult& result) {
    return result.motion.at(0.5 * result.motion.end_time()).pose.position.y();
  };
  ASSERT_LT(side(below), 0.0);
  // The box is seen to reach farther down: a little, then a lot.
  const PlanResult a_little = replan(0.2, below.motion, 0.15);
  ASSERT_EQ(a_little.reason, PlanReason::kSolved);
  EXPECT_LT(side(a_little), 0.0) << "no flipping for a small gain";
  EXPECT_FALSE(a_little.switches_class);
  EXPECT_TRUE(selected(a_little).driven);
  EXPECT_GT(side(replan(0.2, Motion(), 0.15)), 0.0) << "that would be cheaper afresh";
  EXPECT_GT(side(replan(0.2, below.motion, 0.0)), 0.0) << "and without a margin";
  const PlanResult a_lot = replan(1.5, below.motion, 0.15);
  ASSERT_EQ(a_lot.reason, PlanReason::kSolved);
  EXPECT_GT(side(a_lot), 0.0);
  EXPECT_TRUE(a_lot.switches_class);
}

}  // namespace
}  // namespace mocha
