#include "planning/executive/goal_executive.h"

#include <gtest/gtest.h>

#include "planning/executive/executive_fixture.h"

namespace mocha {
namespace {

using Ending = GoalExecutive::Ending;
using GoalExecutiveTest = ExecutiveFixture;

TEST_F(GoalExecutiveTest, PlansAtOnceAndIsDoneWhereTheGoalIsReached) {
  const GoalExecutive::Output first = step();
  ASSERT_TRUE(first.planned);
  ASSERT_TRUE(first.plan);
  EXPECT_DOUBLE_EQ(first.plan->start_time(), now_s_ + options().planning_time_s);
  EXPECT_TRUE(asked_[0].driven.empty());
  state_.pose.position = {kLength_m, 0.1};
  EXPECT_EQ(step().ending, Ending::kReached);
  EXPECT_TRUE(executive_.idle());
  run(5.0);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(GoalExecutiveTest, SaysWhatIsMissing) {
  const auto no_map = executive_.step(now_s_, state_, committed_, {});
  ASSERT_TRUE(no_map.report);
  EXPECT_EQ(no_map.report->reason, PlanReason::kNoMap);
  committed_ = Motion();
  const auto no_motion = step();
  ASSERT_TRUE(no_motion.report);
  EXPECT_EQ(no_motion.report->reason, PlanReason::kNoPose);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(GoalExecutiveTest, WithoutAMapGoalsAreKeptAsLongAsWithoutProgress) {
  const double come_s = now_s_;
  const double timeout_s = options().goals.timeout_s;
  GoalExecutive::Output output;
  for (; now_s_ < come_s + 2.0 * timeout_s; now_s_ += kPeriod_s) {
    output = executive_.step(now_s_, state_, committed_, {});
    if (output.ending != Ending::kNone) break;
    ASSERT_TRUE(output.report);
    EXPECT_EQ(output.report->reason, PlanReason::kNoMap);
  }
  EXPECT_EQ(output.ending, Ending::kNoProgress);
  EXPECT_NEAR(now_s_ - come_s, timeout_s, 2.0 * kPeriod_s);
  EXPECT_TRUE(executive_.idle());
}

TEST_F(GoalExecutiveTest, PlansAtOnceWhenTheMapHasCome) {
  executive_.step(now_s_, state_, committed_, {});
  now_s_ += kPeriod_s;
  EXPECT_TRUE(step().plan);
}

TEST_F(GoalExecutiveTest, WithoutAPoseGoalsAreKeptAsLongAsWithoutProgress) {
  const double timeout_s = options().goals.timeout_s;
  EXPECT_EQ(executive_.wait_for_pose(now_s_ + timeout_s - 0.1).ending, Ending::kNone);
  EXPECT_EQ(executive_.wait_for_pose(now_s_ + timeout_s + 0.1).ending, Ending::kNoProgress);
  EXPECT_TRUE(executive_.idle());
  EXPECT_EQ(executive_.wait_for_pose(now_s_ + 3.0 * timeout_s).ending, Ending::kNone);
}

TEST_F(GoalExecutiveTest, WhilePausedAPoseIsWaitedForWithoutEnd) {
  executive_.pause();
  for (double wait_s = 0.0; wait_s < 300.0; wait_s += 10.0)
    EXPECT_EQ(executive_.wait_for_pose(now_s_ + wait_s).ending, Ending::kNone);
}

TEST_F(GoalExecutiveTest, ReplacesAPlanOnlyByOneThatIsMuchBetter) {
  speed_ = 0.3;
  step();
  const double end_s = executive_.plan().end_time();
  EXPECT_FALSE(run(3.0).plan);  // as fast, but later
  EXPECT_EQ(asked_.size(), 3u);
  EXPECT_DOUBLE_EQ(asked_[0].driven.end_time(), end_s);
  EXPECT_DOUBLE_EQ(executive_.plan().end_time(), end_s);
  speed_ = 0.8;
  EXPECT_TRUE(run(1.0).plan);
  EXPECT_LT(executive_.plan().end_time(), end_s);
}

TEST_F(GoalExecutiveTest, AFailureToImproveIsNoNews) {
  step();
  reason_ = PlanReason::kNotCertified;
  const auto output = run(1.0);
  ASSERT_TRUE(output.planned);
  EXPECT_FALSE(output.report);
  EXPECT_FALSE(executive_.plan().empty());
}

TEST_F(GoalExecutiveTest, AnswersARequestAtOnceButNoMoreOftenThanItCanPlan) {
  step();
  run(0.3);
  executive_.request();
  const auto asked = step();
  ASSERT_TRUE(asked.planned);
  EXPECT_TRUE(asked.plan);  // better or not
  executive_.request();
  run(0.15);
  EXPECT_TRUE(asked_.empty());
  run(0.05);
  EXPECT_EQ(asked_.size(), 1u);
}

TEST_F(GoalExecutiveTest, DrivesThePlanAtHandWhereThereIsNoOther) {
  step();
  const Motion at_hand = executive_.plan();
  reason_ = PlanReason::kNotCertified;
  EXPECT_FALSE(run(3.0).plan);
  EXPECT_EQ(asked_.size(), 3u);
  executive_.request();  // it cannot be driven as it is
  run(0.2);
  EXPECT_EQ(asked_.size(), 1u);
  EXPECT_EQ(executive_.state(), ExecutiveState::kDriving);
  EXPECT_EQ(executive_.plan().end_time(), at_hand.end_time());
}

TEST_F(GoalExecutiveTest, PlansAgainAndAgainWhereThereIsNoPath) {
  reason_ = PlanReason::kNoPath;
  step();
  EXPECT_EQ(executive_.state(), ExecutiveState::kUnreachable);
  run(2.0);
  EXPECT_EQ(asked_.size(), 4u);  // once a retry period
}

TEST_F(GoalExecutiveTest, APlanThatEndsElsewhereIsReplacedByAny) {
  step();
  const double end_s = executive_.plan().end_time();
  reason_ = PlanReason::kNotCertified;
  run(end_s + 1.0 - now_s_);
  EXPECT_EQ(executive_.state(), ExecutiveState::kBlocked);
  EXPECT_TRUE(executive_.plan().empty());
  reason_ = PlanReason::kSolved;
  speed_ = 0.1;
  EXPECT_TRUE(run(0.5).plan);
}

TEST_F(GoalExecutiveTest, AGoalThatIsOccupiedLaterIsApproachedAsFarAsThePlanGoes) {
  step();
  reason_ = PlanReason::kGoalOccupied;
  executive_.request();
  const double end_s = executive_.plan().end_time();
  EXPECT_EQ(run(end_s - now_s_).ending, Ending::kNone);
  EXPECT_EQ(executive_.state(), ExecutiveState::kDriving);
  EXPECT_EQ(run(2.0).ending, Ending::kNone);
  EXPECT_EQ(executive_.state(), ExecutiveState::kGoalOccupied);
  EXPECT_EQ(run(options().occupied_goal_timeout_s).ending, Ending::kGoalOccupied);
  EXPECT_EQ(executive_.state(), ExecutiveState::kIdle);
}

TEST_F(GoalExecutiveTest, GivesUpAGoalThatStaysOccupied) {
  reason_ = PlanReason::kGoalOccupied;
  committed_ = straight_drive(now_s_, {0.0, 0.0}, 0.0, 30.0, 0.8, kBraking);
  EXPECT_EQ(run(options().occupied_goal_timeout_s - 0.5).ending, Ending::kNone);
  const auto given_up = run(1.0);
  EXPECT_EQ(given_up.ending, Ending::kGoalOccupied);
  EXPECT_TRUE(executive_.idle());
  ASSERT_TRUE(given_up.plan);
  EXPECT_TRUE(given_up.plan->empty());  // there is nothing to drive to
}

TEST_F(GoalExecutiveTest, AGoalThatBecomesFreeIsNotGivenUp) {
  reason_ = PlanReason::kGoalOccupied;
  run(2.0);
  reason_ = PlanReason::kNoPath;
  run(2.0);
  reason_ = PlanReason::kGoalOccupied;
  EXPECT_EQ(run(2.0).ending, Ending::kNone);
}

TEST_F(GoalExecutiveTest, GivesUpWithoutProgress) {
  reason_ = PlanReason::kNotCertified;
  EXPECT_EQ(run(options().goals.timeout_s - 1.0).ending, Ending::kNone);
  EXPECT_EQ(run(2.0).ending, Ending::kNoProgress);
  EXPECT_TRUE(executive_.idle());
}

TEST_F(GoalExecutiveTest, FollowsADetourThatLeadsToTheSameGoal) {
  step();
  const Motion plan = executive_.plan();
  executive_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, 3.0, 0.8, kBraking));
  EXPECT_DOUBLE_EQ(executive_.plan().end_time(), plan.end_time());
  executive_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, kLength_m + 0.2, 0.3, kBraking));
  EXPECT_GT(executive_.plan().end_time(), plan.end_time());
  EXPECT_TRUE(run(1.0).plan);  // now the former one is much better
}

TEST_F(GoalExecutiveTest, FollowsNothingToANewGoalBeforeItIsPlannedTo) {
  executive_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, kLength_m, 0.8, kBraking));
  EXPECT_TRUE(executive_.plan().empty());
}

TEST_F(GoalExecutiveTest, GoesToTheFreePlaceNearAnOccupiedGoal) {
  goal_ = Vector2(kLength_m - 0.3, 0.0);
  step();
  state_.pose.position = *goal_;
  EXPECT_EQ(step().ending, Ending::kReached);
}

/// As where a team-mate stood there when the goal was given.
TEST_F(GoalExecutiveTest, GoesToTheGoalItselfOnceThatIsFree) {
  goal_ = Vector2(kLength_m - 0.25, 0.0);
  run(0.2);
  goal_.reset();
  const double replan_s = options().replan_period_s;
  const auto output = run(replan_s + 0.2);
  ASSERT_TRUE(output.plan);
  EXPECT_NEAR(output.plan->end_pose().position.x(), kLength_m, 1e-6);
  goal_ = Vector2(kLength_m - 0.4, 0.0);  // occupied again: the plan at hand may still be driven
  EXPECT_FALSE(run(replan_s + 0.2).plan);
  EXPECT_NEAR(executive_.plan().end_pose().position.x(), kLength_m, 1e-6);
}

TEST_F(GoalExecutiveTest, NewRulesCountAtOnce) {
  step();
  GoalExecutiveOptions faster = options();
  faster.replan_period_s = 0.25;
  executive_.set_options(faster, default_options());
  run(1.0);
  EXPECT_EQ(asked_.size(), 4u);
}

}  // namespace
}  // namespace mocha
