#include "stack/goal_planning.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class GoalPlanningTest : public ::testing::Test {
 protected:
  GoalExecutive::Output step(double now_s) {
    return planning_.step(now_s, {now_s, {{0.0, 0.0}, 0.0}, {0.0, 0.0}}, standing_, scene_);
  }

  const ParameterTable values_ = ParameterTable::from_schema("config/global_planner.yaml");
  const Motion standing_ = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  const std::shared_ptr<const StaticMap> map_ = static_map_of(free_grid({-2.0, -3.0}, {12.0, 3.0}));
  SceneSource scene_ = [this](const std::vector<Vector2>&) { return PlanningScene{map_, {}}; };
  GoalPlanning planning_{rover(), values_, {false, 0, "ugv1"}};
};

TEST_F(GoalPlanningTest, PlansToItsGoal) {
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, kNow_s);
  const auto output = step(kNow_s);
  ASSERT_FALSE(output.plan.empty());
  EXPECT_LT((output.plan.end_pose().position - Vector2(6.0, 0.0)).norm(), 0.01);
}

TEST_F(GoalPlanningTest, WithoutAMapItSaysSo) {
  scene_ = nullptr;
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, kNow_s);
  const auto output = step(kNow_s);
  EXPECT_TRUE(output.plan.empty());
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->reason, PlanReason::kNoMap);
}

TEST_F(GoalPlanningTest, ForgetsItsGoalsWithEachNewEmergencyStop) {
  using StopNews = GoalPlanning::StopNews;
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, kNow_s);
  EXPECT_EQ(planning_.heed(false, 0), StopNews::kNone);
  EXPECT_FALSE(planning_.executive().idle());
  EXPECT_EQ(planning_.heed(true, 1), StopNews::kStopped);
  EXPECT_TRUE(planning_.stopped());
  EXPECT_TRUE(planning_.executive().idle());
  EXPECT_EQ(planning_.heed(true, 1), StopNews::kNone);
  EXPECT_EQ(planning_.heed(false, 1), StopNews::kReset);
  EXPECT_EQ(planning_.heed(false, 1), StopNews::kNone);
}

TEST_F(GoalPlanningTest, AStopThatIsResetBeforeItIsLookedAtCountsToo) {
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, kNow_s);
  EXPECT_EQ(planning_.heed(false, 1), GoalPlanning::StopNews::kStopped);
  EXPECT_FALSE(planning_.stopped());
  EXPECT_TRUE(planning_.executive().idle());
}

TEST_F(GoalPlanningTest, TakesNewOptions) {
  ParameterTable values = values_;
  values.assign(YAML::Load("{goal_search_radius: 0.0}"), "test");
  OccupancyGrid grid = free_grid({-2.0, -3.0}, {12.0, 3.0});
  fill_box(grid, {5.9, -0.1}, {6.1, 0.1});
  const PlanQuery query{kNow_s, standing_, {6.4, 0.0}, {}, {}};
  const SceneSource scene = [&](const auto&) { return PlanningScene{static_map_of(grid), {}}; };
  EXPECT_EQ(planning_.plan(query, scene).reason, PlanReason::kSolved);
  planning_.set_options(values);
  EXPECT_EQ(planning_.plan(query, scene).reason, PlanReason::kGoalOccupied);
}

}  // namespace
}  // namespace mocha
