#include "stack/goal_planning.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kHandover_s = 0.4;

class GoalPlanningTest : public ::testing::Test {
 protected:
  GoalExecutive::Output step(double now_s) {
    return planning_.step(now_s, {now_s, {{0.0, 0.0}, 0.0}, {0.0, 0.0}}, standing_, scene_);
  }

  /// Steps until all goals are given up, in a time between these.
  GoalExecutive::Output run_to_the_end(double least_s, double most_s) {
    GoalExecutive::Output output;
    double time_s = 0.0;
    while (time_s < most_s && output.ending == GoalExecutive::Ending::kNone)
      output = step(kNow_s + (time_s += 0.1));
    EXPECT_GT(time_s, least_s);
    return output;
  }

  static GoalExecutive::Report too_close() {
    GoalExecutive::Report report;
    report.reason = PlanReason::kNotCertified;
    report.violation.term = ViolatedTerm::kClearance;
    report.violation.place = {3.1, 2.0};
    report.violation.value = 0.069;
    report.violation.limit = 0.105;
    report.message = describe(report.violation);
    return report;
  }

  const ParameterTable values_ = ParameterTable::from_schema("config/global_planner.yaml");
  const Motion standing_ = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  std::shared_ptr<const StaticMap> map_ = static_map_of(free_grid({-2.0, -3.0}, {12.0, 3.0}));
  SceneSource scene_ = [this](const std::vector<Vector2>&) { return PlanningScene{map_, {}}; };
  InlinePlanRunner at_once_;
  GoalPlanning planning_{rover(), values_, "ugv1", 0, kHandover_s, at_once_};
};

TEST_F(GoalPlanningTest, PlansToItsGoal) {
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  const auto output = step(kNow_s);
  ASSERT_TRUE(output.plan);
  EXPECT_LT((output.plan->end_pose().position - Vector2(6.0, 0.0)).norm(), 0.01);
}

TEST_F(GoalPlanningTest, WithoutAMapItSaysSo) {
  scene_ = nullptr;
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  const auto output = step(kNow_s);
  EXPECT_FALSE(output.plan);
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->reason, PlanReason::kNoMap);
}

TEST_F(GoalPlanningTest, GivesAGoalUpWithoutAMapAndSaysSo) {
  scene_ = nullptr;
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  step(kNow_s);
  EXPECT_EQ(step(kNow_s + 59.0).ending, GoalExecutive::Ending::kNone);
  const auto output = step(kNow_s + 61.0);
  EXPECT_EQ(output.ending, GoalExecutive::Ending::kNoProgress);
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->reason, PlanReason::kNoMap);
  EXPECT_EQ(output.report->message.find("no progress for 60 s: no map on "), 0u)
      << output.report->message;
}

TEST_F(GoalPlanningTest, SaysWhatThePoseLacksAndForHowLong) {
  EXPECT_FALSE(planning_.wait_for_pose(kNow_s, "no odometry").report) << "has no goal";
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  auto output = planning_.wait_for_pose(kNow_s + 59.0, "no odometry");
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->reason, PlanReason::kNoPose);
  EXPECT_EQ(output.report->message, "no odometry");
  output = planning_.wait_for_pose(kNow_s + 61.0, "no odometry");
  EXPECT_EQ(output.ending, GoalExecutive::Ending::kNoProgress);
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->message, "no progress for 60 s: no odometry");
}

TEST_F(GoalPlanningTest, ForgetsItsGoalsWithEachNewEmergencyStop) {
  using StopNews = GoalPlanning::StopNews;
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
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
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  EXPECT_EQ(planning_.heed(false, 1), GoalPlanning::StopNews::kStopped);
  EXPECT_FALSE(planning_.stopped());
  EXPECT_TRUE(planning_.executive().idle());
}

TEST_F(GoalPlanningTest, SaysWhatTheLocalReplannerCannotPromiseAsSoonAsItIsNews) {
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  EXPECT_EQ(step(kNow_s).report->reason, PlanReason::kSolved);
  planning_.hear_replanner(too_close(), kNow_s + 0.1);
  const auto output = step(kNow_s + 0.1);
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->reason, PlanReason::kNotCertified);
  EXPECT_EQ(output.report->message, "local replanner: " + describe(too_close().violation));
  EXPECT_EQ(output.report->violation.place, Vector2(3.1, 2.0));
  EXPECT_FALSE(step(kNow_s + 0.15).report);
  planning_.hear_replanner({}, kNow_s + 0.2);
  EXPECT_EQ(step(kNow_s + 2.3).report->reason, PlanReason::kSolved);
}

TEST_F(GoalPlanningTest, WithoutProgressItSaysForHowLongAndWhy) {
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  step(kNow_s);
  planning_.hear_replanner(too_close(), kNow_s + 0.1);
  const auto output = run_to_the_end(59.0, 62.0);
  EXPECT_EQ(output.ending, GoalExecutive::Ending::kNoProgress);
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->reason, PlanReason::kNotCertified);
  EXPECT_EQ(output.report->message,
            "no progress for 60 s: local replanner: " + describe(too_close().violation));
}

TEST_F(GoalPlanningTest, WhereNobodyObjectsItDoesNotSaySolved) {
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  const auto output = run_to_the_end(59.0, 62.0);
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->message,
            "no progress for 60 s: it has a plan, and neither planner objects to it");
}

TEST_F(GoalPlanningTest, WhereNoPathLeadsItSaysSoAtOnceAndGivesUpSoon) {
  OccupancyGrid grid = free_grid({-2.0, -3.0}, {12.0, 3.0});
  fill_box(grid, {4.0, -3.0}, {4.2, 3.0});
  fill_box(grid, {-2.0, -3.0}, {12.0, -2.8});
  fill_box(grid, {-2.0, 2.8}, {12.0, 3.0});
  map_ = static_map_of(grid);
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  const auto first = step(kNow_s);
  ASSERT_TRUE(first.report);
  EXPECT_EQ(first.report->reason, PlanReason::kNoPath);
  planning_.hear_replanner(too_close(), kNow_s);  // of what it does without a plan
  const auto last = run_to_the_end(2.5, 4.0);
  EXPECT_EQ(last.ending, GoalExecutive::Ending::kUnreachable);
  ASSERT_TRUE(last.report);
  EXPECT_EQ(last.report->reason, PlanReason::kNoPath);
  EXPECT_NE(
      last.report->message.find("to (6.00, 0.00) on the map; the nearest place in reach is (3."),
      std::string::npos)
      << last.report->message;
}

TEST_F(GoalPlanningTest, SaysThatItIsPaused) {
  planning_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  step(kNow_s);
  planning_.executive().pause();
  EXPECT_EQ(step(kNow_s + 0.05).report->reason, PlanReason::kPaused);
  EXPECT_FALSE(step(kNow_s + 0.1).report);
  planning_.executive().resume();
  step(kNow_s + 0.15);
  EXPECT_EQ(step(kNow_s + 0.2).report->reason, PlanReason::kSolved);
}

TEST_F(GoalPlanningTest, TakesNewOptions) {
  ParameterTable values = values_;
  values.assign(YAML::Load("{goal_search_radius: 0.0}"), "test");
  OccupancyGrid grid = free_grid({-2.0, -3.0}, {12.0, 3.0});
  fill_box(grid, {1.15, -0.1}, {1.35, 0.1});
  PlanQuery query;
  query.start_time_s = kNow_s;
  query.committed = standing_;
  query.goal = {1.1, 0.0};  // near, where the radius counts
  const SceneSource scene = [&](const auto&) { return PlanningScene{static_map_of(grid), {}}; };
  const auto go_on = [] { return false; };
  EXPECT_EQ(planning_.work_on(query, scene)(go_on).reason, PlanReason::kSolved);
  planning_.set_options(values);
  EXPECT_EQ(planning_.work_on(query, scene)(go_on).reason, PlanReason::kGoalOccupied);
}

/// Keeps what it is to do until it is told to do it.
class LateRunner : public PlanRunner {
 public:
  void begin(Work work, double time_limit_s) override {
    work_ = std::move(work);
    time_limit_s_ = time_limit_s;
    answer_.reset();
  }
  std::optional<PlanResult> answer() override { return std::exchange(answer_, std::nullopt); }
  void work() {
    answer_ = work_([] { return false; });
  }
  double time_limit_s() const { return time_limit_s_; }

 private:
  Work work_;
  double time_limit_s_ = 0.0;
  std::optional<PlanResult> answer_;
};

class LatePlanningTest : public GoalPlanningTest {
 protected:
  GoalExecutive::Output step_late(double now_s) {
    return late_.step(now_s, {now_s, {{0.0, 0.0}, 0.0}, {0.0, 0.0}}, standing_, scene_);
  }

  LateRunner runner_;
  GoalPlanning late_{rover(), values_, "ugv1", 0, kHandover_s, runner_};
};

TEST_F(LatePlanningTest, StepsGoOnWhileAPlanIsUnderWay) {
  late_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  EXPECT_FALSE(step_late(kNow_s).plan);
  EXPECT_TRUE(late_.executive().awaits_plan());
  EXPECT_DOUBLE_EQ(runner_.time_limit_s(), values_.number("planning_time"));
  EXPECT_FALSE(step_late(kNow_s + 0.3).plan);
  runner_.work();
  const auto output = step_late(kNow_s + 0.35);
  EXPECT_FALSE(late_.executive().awaits_plan());
  ASSERT_TRUE(output.plan);
  EXPECT_DOUBLE_EQ(output.plan->start_time(), kNow_s + values_.number("planning_time"));
}

TEST_F(LatePlanningTest, AnotherGoalStopsWhatIsUnderWay) {
  late_.executive().take({Goal{{6.0, 0.0}, std::nullopt}}, standing_, kNow_s);
  step_late(kNow_s);
  late_.executive().take({Goal{{4.0, 1.0}, std::nullopt}}, standing_, kNow_s + 0.05);
  runner_.work();  // what was begun for the first goal
  double now_s = kNow_s;
  for (int i = 0; i < 5 && !late_.executive().awaits_plan(); ++i) {
    const auto output = step_late(now_s += 0.05);
    EXPECT_TRUE(!output.plan || output.plan->empty());  // it was about to set off, so it brakes
  }
  runner_.work();
  const auto output = step_late(now_s + 0.05);
  ASSERT_TRUE(output.plan);
  EXPECT_LT((output.plan->end_pose().position - Vector2(4.0, 1.0)).norm(), 0.01);
}

}  // namespace
}  // namespace mocha
