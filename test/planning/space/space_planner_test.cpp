#include "planning/space/space_planner.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "safety/curve_certificate.h"
#include "world/space_worlds.h"

namespace mocha {
namespace {

using Eigen::Vector3d;

SpacePlannerOptions shipped_space_options() {
  return SpacePlannerOptions::from(ParameterTable::from_schema("config/space_planner.yaml"));
}

SpacePlanner planner_in(const VoxelGrid& grid,
                        const SpacePlannerOptions& options = shipped_space_options()) {
  return SpacePlanner(
      std::make_shared<VoxelDistanceField>(grid, VoxelDistanceField::Solid::kOccupiedOrUnknown),
      options);
}

/// What is said of each candidate holds: by another proof, and by looking at many places.
void expect_sound(const SpacePlan& plan, const SpaceWorld& world, const SpacePlanner& planner) {
  const SpacePlannerOptions options = shipped_space_options();
  std::set<Signature> signatures;
  double last_cost = 0.0;
  for (const SpaceCandidate& candidate : plan.candidates) {
    ASSERT_EQ(candidate.reason, PlanReason::kSolved) << outcome(candidate);
    EXPECT_TRUE(signatures.insert(candidate.signature).second);
    EXPECT_GE(candidate.cost, last_cost);
    last_cost = candidate.cost;
    const auto& curve = candidate.curve;
    const double end_s = curve.duration();
    EXPECT_LT((curve.position(0.0) - world.start).norm(), 1e-9);
    EXPECT_LT((curve.position(end_s) - world.goal).norm(), 1e-6);
    EXPECT_LT(curve.derivative(0.0, 1).norm() + curve.derivative(end_s, 1).norm(), 1e-6);
    for (double t = 0.0; t < end_s; t += 0.01) {
      EXPECT_GE(planner.field().distance_bound(curve.position(t)),
                options.required_clearance_m() - 1e-3);
      EXPECT_LE(curve.derivative(t, 1).norm(), options.max_speed + 1e-6);
      EXPECT_LE(curve.derivative(t, 2).norm(), options.max_acceleration + 1e-6);
    }
  }
}

TEST(SpacePlanner, PlansAllClassesOfEachWorld) {
  const std::vector<std::size_t> classes = {6, 2, 2, 4};
  const auto worlds = space_worlds();
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const auto& [name, world] = worlds[i];
    SCOPED_TRACE(name);
    SpacePlanner planner = planner_in(world.grid);
    const SpacePlan plan = planner.plan({world.start, world.goal});
    ASSERT_EQ(plan.reason, PlanReason::kSolved) << plan.message;
    EXPECT_EQ(plan.candidates.size(), classes[i]);
    EXPECT_EQ(plan.selected(), &plan.candidates.front());
    expect_sound(plan, world, planner);
  }
}

TEST(SpacePlanner, PlansTheSameAgain) {
  const SpaceWorld world = two_storeys(0.1);
  SpacePlanner planner = planner_in(world.grid);
  const SpacePlan first = planner.plan({world.start, world.goal});
  const SpacePlan second = planner.plan({world.start, world.goal});
  ASSERT_EQ(first.candidates.size(), second.candidates.size());
  for (std::size_t i = 0; i < first.candidates.size(); ++i)
    EXPECT_EQ(first.candidates[i].cost, second.candidates[i].cost);
}

TEST(SpacePlanner, PlansOnlyAsManyClassesAsAreAskedFor) {
  const SpaceWorld world = two_storeys(0.1);
  SpacePlanner planner = planner_in(world.grid);
  SpaceQuery query{world.start, world.goal};
  query.classes = 1;
  EXPECT_EQ(planner.plan(query).candidates.size(), 1u);
}

TEST(SpacePlanner, SaysWhyThereIsNoPlan) {
  const SpaceWorld world = two_windows(0.1);
  SpacePlanner planner = planner_in(world.grid);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto plan = [&](const Vector3d& start, const Vector3d& goal) {
    const SpacePlan found = planner.plan({start, goal});
    EXPECT_EQ(found.selected(), nullptr);
    EXPECT_TRUE(found.candidates.empty());
    EXPECT_FALSE(found.message.empty());
    return found.reason;
  };
  EXPECT_EQ(plan({kNan, 1.0, 1.0}, world.goal), PlanReason::kInvalidInput);
  EXPECT_EQ(plan(world.start, {1.0, std::numeric_limits<double>::infinity(), 1.0}),
            PlanReason::kInvalidInput);
  EXPECT_EQ(plan(world.start, world.start), PlanReason::kInvalidInput);
  EXPECT_EQ(plan({5.0, 4.0, 1.5}, world.goal), PlanReason::kStartOccupied);
  EXPECT_EQ(plan({4.7, 4.0, 1.5}, world.goal), PlanReason::kStartOccupied);
  EXPECT_EQ(plan({1e300, 4.0, 1.5}, world.goal), PlanReason::kStartOccupied);
  EXPECT_EQ(plan(world.start, {9.0, 4.0, 5.5}), PlanReason::kGoalOccupied);
  EXPECT_EQ(plan(world.start, {9.0, 4.0, 0.2}), PlanReason::kGoalOccupied);
  SpaceQuery stopped{world.start, world.goal};
  stopped.should_stop = [] { return true; };
  EXPECT_EQ(planner.plan(stopped).reason, PlanReason::kBudgetExhausted);
}

TEST(SpacePlanner, FindsNoWayToWhereThereIsNone) {
  SpacePlannerOptions options = shipped_space_options();
  options.radius_m = 0.85;  // windows are 1.6 m wide
  const SpaceWorld world = two_windows(0.1);
  EXPECT_EQ(planner_in(world.grid, options).plan({world.start, world.goal}).reason,
            PlanReason::kNoPath);
}

TEST(SpacePlanner, TellsRoomsApartThatAreNotJoined) {
  SpaceWorld world = two_windows(0.1);
  for (int z = 0; z < world.grid.size.z(); ++z) {
    for (int y = 0; y < world.grid.size.y(); ++y) world.grid.at(50, y, z) = VoxelGrid::kOccupied;
  }
  SpacePlanner planner = planner_in(world.grid);
  EXPECT_EQ(planner.plan({world.start, world.goal}).reason, PlanReason::kNoPath);
  EXPECT_EQ(planner.plan({world.goal, {8.0, 2.0, 2.0}}).reason, PlanReason::kSolved);
  EXPECT_NE(planner.region_of(world.start), planner.region_of(world.goal));
  EXPECT_EQ(planner.region_of(world.start), planner.region_of({2.0, 2.0, 2.0}));
  EXPECT_EQ(planner.region_of({5.0, 4.0, 1.5}), nullptr);
}

}  // namespace
}  // namespace mocha
