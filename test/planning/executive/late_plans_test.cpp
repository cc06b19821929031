// Plans that are under way while the executive steps.
#include <gtest/gtest.h>

#include "planning/executive/executive_fixture.h"

namespace mocha {
namespace {

using S = ExecutiveState;
using LatePlansTest = ExecutiveFixture;

TEST_F(LatePlansTest, AreAskedForOnceAndDrivenWhenTheyCome) {
  late_ = true;
  run(2.0);
  EXPECT_EQ(asked_.size(), 1u);
  EXPECT_TRUE(executive_.awaits_plan());
  EXPECT_FALSE(query_.should_stop());
  late_ = false;
  const GoalExecutive::Output output = step();
  ASSERT_TRUE(output.plan);
  EXPECT_FALSE(executive_.awaits_plan());
  EXPECT_TRUE(query_.should_stop());
  EXPECT_EQ(executive_.state(), S::kDriving);
}

TEST_F(LatePlansTest, StopAsSoonAsTheGoalIsAnotherOrNone) {
  late_ = true;
  step();
  PlanQuery first = query_;
  executive_.take({Goal{{3.0, 0.0}, std::nullopt}}, committed_, now_s_);
  EXPECT_TRUE(first.should_stop());
  run(0.2);  // it was about to set off, so it brakes before
  EXPECT_EQ(query_.goal, Vector2(3.0, 0.0));
  EXPECT_FALSE(query_.should_stop());
  EXPECT_TRUE(first.should_stop());
  executive_.pause();
  EXPECT_TRUE(query_.should_stop());
  executive_.resume();
  run(0.2);
  EXPECT_FALSE(query_.should_stop());
  executive_.drop();
  EXPECT_TRUE(query_.should_stop());
}

TEST_F(LatePlansTest, ARequestStopsOneThatWasBegunForAnotherReason) {
  step();
  late_ = true;
  run(1.0);  // a better plan is looked for
  ASSERT_TRUE(executive_.awaits_plan());
  const PlanQuery better = query_;
  executive_.request();
  EXPECT_TRUE(better.should_stop());
  run(0.25);
  ASSERT_EQ(asked_.size(), 1u);
  executive_.request();  // once more, while it is worked on
  EXPECT_FALSE(query_.should_stop());
}

TEST_F(LatePlansTest, FromRestMayTakeAllOfTheTimeAndUnderWayWhatIsNotNeededToSettle) {
  step();
  EXPECT_DOUBLE_EQ(query_.time_limit_s, options().planning_time_s);
  committed_ = straight_drive(now_s_ - 1.0, {0.0, 0.0}, 0.0, kLength_m, 0.8, kBraking);
  executive_.request();
  run(0.25);
  EXPECT_DOUBLE_EQ(query_.time_limit_s, options().planning_time_s - kHandover_s);
}

TEST_F(LatePlansTest, HaveTwiceTheTimeWhereItDidNotSuffice) {
  reason_ = PlanReason::kBudgetExhausted;
  const double usual_s = options().planning_time_s;
  for (const double times : {1.0, 2.0, 4.0, 8.0, 16.0, 16.0}) {
    run(options().retry_period_s);
    EXPECT_DOUBLE_EQ(query_.time_limit_s, times * usual_s);
    EXPECT_NEAR(query_.start_time_s, now_s_ + times * usual_s, options().retry_period_s);
  }
  reason_ = PlanReason::kSolved;
  run(options().retry_period_s);
  ASSERT_EQ(executive_.state(), S::kDriving);
  for (const double times : {8.0, 4.0, 2.0, 1.0, 1.0}) {
    run(options().replan_period_s);
    EXPECT_DOUBLE_EQ(query_.time_limit_s, times * usual_s);
  }
}

TEST_F(LatePlansTest, UnderWayTheyDoNotBeginWhereThePromiseMayHaveBeenExtended) {
  step();
  reason_ = PlanReason::kBudgetExhausted;
  for (int i = 0; i < 6; ++i) {
    committed_ = straight_drive(now_s_ - 1.0, {0.0, 0.0}, 0.0, kLength_m, 0.4, kBraking);
    run(options().replan_period_s);
  }
  EXPECT_NEAR(query_.start_time_s, now_s_ + 4.0 * options().planning_time_s,
              options().replan_period_s);
}

TEST_F(LatePlansTest, AnAnswerForAGoalIsNotDrivenWhereTheRobotHasToMakeRoom) {
  late_ = true;
  step();
  const PlanQuery to_goal = query_;
  ASSERT_FALSE(to_goal.should_stop());
  executive_.hear(ordered({{0.0, 0.0}, {0.0, 2.0}}), now_s_);
  step();
  EXPECT_TRUE(to_goal.should_stop());
  EXPECT_EQ(query_.goal, Vector2(0.0, 2.0));
  EXPECT_FALSE(query_.should_stop());
}

TEST_F(LatePlansTest, NoAnswerIsDrivenWhereTheRobotHasToWait) {
  late_ = true;
  step();
  executive_.hear(ordered({{0.0, 0.0}, {2.0, 0.0}}, {1}), now_s_);
  step();
  EXPECT_TRUE(query_.should_stop());
  late_ = false;
  EXPECT_FALSE(run(1.0).planned);
  EXPECT_EQ(executive_.state(), S::kWaiting);
}

}  // namespace
}  // namespace mocha
