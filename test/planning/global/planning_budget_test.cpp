#include <algorithm>
#include <atomic>
#include <memory>

#include "planning/global/global_planner_fixture.h"
#include "planning/global/global_rules.h"

namespace mocha {
namespace {

/// Straight ahead, with little time.
class PlanningBudget : public GlobalPlannerTest {
 protected:
  PlanResult plan(const OccupancyGrid& grid) const { return GlobalPlannerTest::plan(query_, grid); }

  PlanQuery query_ = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
};

TEST_F(PlanningBudget, StopsWorkingWhenToldTo) {
  std::atomic<int> calls{0};
  for (const int allowed : {0, 1, 30}) {
    calls = 0;
    query_.should_stop = [&] { return ++calls > allowed; };
    const PlanResult result = plan(open_);
    if (result.reason == PlanReason::kSolved) continue;  // was fast enough
    EXPECT_EQ(result.reason, PlanReason::kBudgetExhausted);
    EXPECT_TRUE(result.motion.empty());
    EXPECT_EQ(result.message.find("no violation"), std::string::npos) << result.message;
  }
}

TEST_F(PlanningBudget, StoppedAnywhereItHasAProvedMotionOrSaysThatTimeIsUp) {
  OccupancyGrid grid = free_grid({-2.0, -4.0}, {10.0, 4.0});
  fill_box(grid, {3.0, -1.0}, {4.0, 1.0});
  std::atomic<int> calls{0};
  query_.should_stop = [&] { return ++calls < 0; };
  ASSERT_EQ(plan(grid).reason, PlanReason::kSolved);
  const int all = calls;
  int solved = 0;
  for (int allowed = 0; allowed < all; allowed += std::max(1, all / 40)) {
    calls = 0;
    query_.should_stop = [&] { return ++calls > allowed; };
    const PlanResult result = plan(grid);
    solved += result.reason == PlanReason::kSolved;
    if (result.reason == PlanReason::kSolved) {
      EXPECT_FALSE(certify_plan(result.motion, rover(), {static_map_of(grid), {}}, kStart_s));
    } else {
      EXPECT_EQ(result.reason, PlanReason::kBudgetExhausted) << result.message;
    }
  }
  EXPECT_GT(solved, 3);  // before all has been looked at
}

TEST_F(PlanningBudget, StoppedAfterTheDrivenPathHasFailedItDoesNotSayThatAllHas) {
  query_.driven = plan(open_).motion;
  // Nothing around has been seen, so that no motion is certified.
  OccupancyGrid unseen = open_;
  fill_box(unseen, {-2.0, -4.0}, {10.0, 4.0}, OccupancyGrid::kUnknown);
  PlannerOptions options = default_options();
  options.max_evaluations = 10;
  options.threads = 1;
  const GlobalPlanner planner(rover(), options);
  const PlanningScene scene{static_map_of(open_), {}, [&] {
                              return std::make_shared<DistanceField>(
                                  unseen, DistanceField::Solid::kOccupiedOrUnknown);
                            }};
  std::atomic<int> calls{0};
  query_.should_stop = [&] { return ++calls < 0; };
  ASSERT_EQ(planner.plan(query_, scene).reason, PlanReason::kNotCertified);
  const int all = calls;
  for (int allowed = 0; allowed < all * 9 / 10; allowed += std::max(1, all / 50)) {
    calls = 0;
    query_.should_stop = [&] { return ++calls > allowed; };
    EXPECT_EQ(planner.plan(query_, scene).reason, PlanReason::kBudgetExhausted) << allowed;
  }
}

TEST_F(PlanningBudget, TheWorkThatItMayTakeFollowsTheTimeLimit) {
  query_.time_limit_s = 0.5;
  const PlanResult enough = plan(open_);
  ASSERT_EQ(enough.reason, PlanReason::kSolved);
  query_.time_limit_s = 1e-5;
  const PlanResult little = plan(open_);
  for (const PlanCandidate& candidate : little.candidates)
    EXPECT_LE(candidate.evaluations, 1);  // of the whole drive, as it has to begin somewhere
  EXPECT_LT(little.candidates.front().work, enough.candidates.front().work);
}

}  // namespace
}  // namespace mocha
