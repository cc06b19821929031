#include "planning/space/space_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "world/space_worlds.h"

namespace mocha {
namespace {

using Eigen::Vector3d;

SpacePlannerOptions shipped_space_options() {
  return SpacePlannerOptions::from(ParameterTable::from_schema("config/space_planner.yaml"));
}

SpacePlanner planner_in(
    const VoxelGrid& grid, const SpacePlannerOptions& options = shipped_space_options(),
    std::function<double()> now_s = [] { return 0.0; }) {
  return SpacePlanner(
      std::make_shared<VoxelDistanceField>(grid, VoxelDistanceField::Solid::kOccupiedOrUnknown),
      options, std::move(now_s));
}

/// What is said of each candidate holds, by looking at many places.
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

TEST(SpacePlanner, SaysThatTimeRanOutHoweverFarItCame) {
  const SpaceWorld world = two_windows(0.1);
  SpacePlanner planner = planner_in(world.grid);
  int looks = 0;
  SpaceQuery query{world.start, world.goal};
  query.should_stop = [&] {
    ++looks;
    return false;
  };
  planner.plan(query);
  for (int most = 0; most < std::min(looks, 12); ++most) {
    std::atomic<int> left = most;
    query.should_stop = [&] { return left-- <= 0; };
    const SpacePlan found = planner.plan(query);
    if (found.reason == PlanReason::kSolved) continue;
    EXPECT_EQ(found.reason, PlanReason::kBudgetExhausted) << most;
    EXPECT_EQ(found.message.rfind("out of time", 0), 0u) << found.message;
  }
}

TEST(SpacePlanner, PlansByWhatWasFoundWhenItsTimeForSearchingIsOver) {
  const SpaceWorld world = two_windows(0.1);
  SpacePlannerOptions options = shipped_space_options();
  options.prm_samples = 1'000'000;  // would take minutes
  std::atomic<int> looks = 0;
  SpacePlanner planner =
      planner_in(world.grid, options, [&] { return 1e-3 * options.planning_time_s * looks++; });
  const SpacePlan plan = planner.plan({world.start, world.goal});
  EXPECT_EQ(plan.reason, PlanReason::kSolved) << plan.message;
  EXPECT_GT(plan.took_s, 0.25 * options.planning_time_s);
  EXPECT_LT(plan.took_s, 1.1 * options.planning_time_s);
}

TEST(SpacePlanner, SaysThatItsTimeIsOver) {
  const SpaceWorld world = two_windows(0.1);
  const SpacePlannerOptions options = shipped_space_options();
  std::atomic<int> looks = 0;
  SpacePlanner planner =
      planner_in(world.grid, options, [&] { return 0.4 * options.planning_time_s * looks++; });
  const SpacePlan plan = planner.plan({world.start, world.goal});
  EXPECT_EQ(plan.reason, PlanReason::kBudgetExhausted) << plan.message;
  EXPECT_EQ(plan.message.rfind("out of time", 0), 0u) << plan.message;
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

TEST(SpacePlanner, ForgetsARegionWhereThereAreMany) {
  constexpr int kRooms = 6;
  VoxelGrid grid;
  grid.size = {16 * kRooms, 20, 20};
  grid.cells.assign(static_cast<std::size_t>(grid.size.prod()), VoxelGrid::kFree);
  for (int x = 0; x < grid.size.x(); x += 16) {
    for (int z = 0; z < grid.size.z(); ++z)
      for (int y = 0; y < grid.size.y(); ++y) grid.at(x, y, z) = VoxelGrid::kOccupied;
  }
  SpacePlanner planner = planner_in(grid);
  const Vector3d in_first(0.8, 0.5, 0.5);
  const auto first = planner.region_of(in_first);
  EXPECT_EQ(planner.region_of(in_first), first);
  for (int again = 0; again < 2; ++again) {
    for (int room = 0; room < kRooms; ++room) {
      const double x_m = 1.6 * room + 0.8;
      EXPECT_EQ(planner.plan({{x_m, 0.5, 0.5}, {x_m, 1.5, 1.5}}).reason, PlanReason::kSolved);
      EXPECT_EQ(planner.plan({{x_m, 0.5, 0.5}, {std::fmod(x_m + 1.6, 9.6), 1.5, 1.5}}).reason,
                PlanReason::kNoPath);
    }
  }
  EXPECT_NE(planner.region_of(in_first), first);
}

class AmongMoving : public testing::Test {
 protected:
  SpacePlan plan(const std::vector<Tube<3>>& moving) {
    SpaceQuery query{world_.start, world_.goal};
    query.moving = moving;
    return planner_.plan(query);
  }

  /// What is certified keeps away from all that moves, by looking at many moments.
  void expect_apart(const SpacePlan& plan, const std::vector<Tube<3>>& moving) {
    const SpacePlannerOptions options = shipped_space_options();
    for (const SpaceCandidate& candidate : plan.candidates) {
      if (candidate.reason != PlanReason::kSolved) continue;
      for (double t = 0.0; t < candidate.curve.duration(); t += 0.01) {
        for (const Tube<3>& tube : moving) {
          EXPECT_GE((candidate.curve.position(t) - tube.front().centre_at(t)).norm(),
                    tube.front().radius_m + options.required_clearance_m() - 1e-3);
        }
      }
    }
  }

  const SpaceWorld world_ = two_windows(0.1);
  SpacePlanner planner_ = planner_in(world_.grid);
};

TEST_F(AmongMoving, LetsABallPassAndTakesNoDetourForOneFarAway) {
  const double free_s = plan({}).selected()->curve.duration();
  const std::vector<Tube<3>> far = {steady_tube<3>({9.0, 7.0, 4.0}, {0.0, 0.0, 0.0}, 0.3)};
  EXPECT_NEAR(plan(far).selected()->curve.duration(), free_s, 0.02 * free_s);
  // It crosses in front of the window while the robot would be there.
  const std::vector<Tube<3>> crossing = {steady_tube<3>({4.2, 0.6, 1.8}, {0.0, 0.6, 0.0}, 0.5)};
  const SpacePlan found = plan(crossing);
  ASSERT_EQ(found.reason, PlanReason::kSolved) << found.message;
  expect_apart(found, crossing);
}

TEST_F(AmongMoving, GoesByTheOtherWindowWhereOneIsBlocked) {
  const Signature near = plan({}).selected()->signature;
  const std::vector<Tube<3>> plug = {steady_tube<3>({5.0, 2.0, 1.8}, {0.0, 0.0, 0.0}, 0.6)};
  const SpacePlan found = plan(plug);
  ASSERT_EQ(found.reason, PlanReason::kSolved) << found.message;
  EXPECT_NE(found.selected()->signature, near);
  expect_apart(found, plug);
}

TEST_F(AmongMoving, SaysWhatIsInTheWayWhereBothAreBlocked) {
  const SpacePlan found = plan({steady_tube<3>({5.0, 2.0, 1.8}, {0.0, 0.0, 0.0}, 1.0),
                                steady_tube<3>({5.0, 6.2, 3.0}, {0.0, 0.0, 0.0}, 1.0)});
  EXPECT_EQ(found.reason, PlanReason::kNotCertified);
  EXPECT_EQ(found.selected(), nullptr);
  ASSERT_FALSE(found.candidates.empty());
  const BasicViolation<3>& violation = found.candidates.front().violation;
  EXPECT_TRUE(violation.term == ViolatedTerm::kClearance ||
              violation.term == ViolatedTerm::kSeparation);
  EXPECT_LT(violation.value, violation.limit);
  EXPECT_NEAR(violation.place.x(), 5.0, 1.5);
  EXPECT_NE(found.message.find(describe(violation)), std::string::npos) << found.message;
}

TEST_F(AmongMoving, IsSoundAmongMany) {
  std::mt19937 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int solved = 0;
  for (int run = 0; run < 12; ++run) {
    std::vector<Tube<3>> moving;
    for (int k = 0; k < 3; ++k) {
      const Vector3d velocity(uniform(-0.8, 0.8), uniform(-0.8, 0.8), uniform(-0.3, 0.3));
      const Vector3d met(uniform(3.0, 7.0), uniform(1.0, 7.0), uniform(1.0, 4.0));
      moving.push_back(steady_tube<3>(met - uniform(1.5, 4.0) * velocity, velocity, 0.4));
    }
    const SpacePlan found = plan(moving);
    solved += found.reason == PlanReason::kSolved;
    expect_apart(found, moving);
  }
  EXPECT_GE(solved, 10);
}

}  // namespace
}  // namespace mocha
