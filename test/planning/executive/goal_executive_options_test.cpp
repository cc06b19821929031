#include "planning/executive/goal_executive_options.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

using S = ExecutiveState;

TEST(GoalExecutiveOptions, AreThoseOfTheSchema) {
  ParameterTable values = ParameterTable::from_schema("config/global_planner.yaml");
  values.assign(YAML::Load("{replan_period: 1.5, retry_period: 0.4, planning_time: 0.7, "
                           "occupied_goal_timeout: 2.0, "
                           "unreachable_timeout: 4.0}"),
                "test");
  const auto options = GoalExecutiveOptions::from(values, 0.4);
  EXPECT_EQ(options.planning_time_s, 0.7);
  EXPECT_EQ(options.handover_s, 0.4);
  EXPECT_EQ(options.planning_period_s(S::kDriving), 1.5);
  for (const S state : {S::kBlocked, S::kGoalOccupied, S::kUnreachable})
    EXPECT_EQ(options.planning_period_s(state), 0.4) << to_text(state);
  EXPECT_EQ(options.patience_s(S::kGoalOccupied), 2.0);
  EXPECT_EQ(options.patience_s(S::kUnreachable), 4.0);
  EXPECT_FALSE(options.patience_s(S::kBlocked));
}

TEST(GoalExecutiveOptions, PlanSoonWhereThereIsNoPlanYetAndNotAtAllWhereNoneIsNeeded) {
  const auto options =
      GoalExecutiveOptions::from(ParameterTable::from_schema("config/global_planner.yaml"), 0.4);
  for (const S state : {S::kPlanning, S::kReplanning})
    EXPECT_LT(options.planning_period_s(state), options.retry_period_s) << to_text(state);
  for (const S state : {S::kIdle, S::kParked, S::kPaused, S::kBraking, S::kWaiting})
    EXPECT_FALSE(options.planning_period_s(state)) << to_text(state);
}

}  // namespace
}  // namespace mocha
