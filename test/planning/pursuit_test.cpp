#include "planning/pursuit.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

using Ending = Pursuit::Ending;

constexpr double kPeriod_s = 0.05;
constexpr double kAcceleration = 0.5;
constexpr double kLength_m = 6.0;

PursuitRules rules() {
  return PursuitRules::from(ParameterTable::from_schema("config/global_planner.yaml"));
}

/// A robot that stands, or is where its plan says, and a planner that finds what it is told to.
class PursuitTest : public ::testing::Test {
 protected:
  PursuitTest() { pursuit_.take({Goal{{kLength_m, 0.0}, std::nullopt}}, now_s_); }

  PlanResult answer(const PlanQuery& query) {
    asked_.push_back(query);
    PlanResult result;
    result.reason = reason_;
    result.goal = goal_.value_or(query.goal);
    const Pose from = query.committed.at(query.start_time_s).pose;
    if (reason_ == PlanReason::kSolved) {
      result.motion = straight_drive(query.start_time_s, from.position, 0.0,
                                     (result.goal - from.position).norm(), speed_, kAcceleration);
    } else if (reason_ == PlanReason::kBackingOut) {
      result.motion = Motion(query.start_time_s, {StandPhase{from, 2.0}});
    }
    return result;
  }

  Pursuit::Output step() {
    now_s_ += kPeriod_s;
    state_.stamp_s = now_s_;
    return pursuit_.step(now_s_, state_, committed_,
                         [this](const PlanQuery& query) { return answer(query); });
  }

  /// The last step of so many that said anything; the number of plans asked for is in asked_.
  Pursuit::Output run(double time_s) {
    Pursuit::Output last;
    asked_.clear();
    for (const double end_s = now_s_ + time_s; now_s_ < end_s - 1e-6;) {
      Pursuit::Output output = step();
      if (output.planned || output.ending != Ending::kNone) last = std::move(output);
    }
    return last;
  }

  double now_s_ = 1.7e9;
  Pursuit pursuit_{rules(), kAcceleration};
  RobotState state_;
  Motion committed_ = standing(now_s_, {0.0, 0.0}, 0.0);
  PlanReason reason_ = PlanReason::kSolved;
  std::optional<Vector2> goal_;  // where the plan leads instead
  double speed_ = 0.8;
  std::vector<PlanQuery> asked_;
};

TEST_F(PursuitTest, PlansAtOnceAndIsDoneWhereTheGoalIsReached) {
  const Pursuit::Output first = step();
  ASSERT_TRUE(first.planned);
  ASSERT_FALSE(first.plan.empty());
  EXPECT_DOUBLE_EQ(first.plan.start_time(), now_s_ + rules().planning_time_s);
  EXPECT_TRUE(asked_[0].driven.empty());
  state_.pose.position = {kLength_m, 0.1};
  EXPECT_EQ(step().ending, Ending::kReached);
  EXPECT_TRUE(pursuit_.idle());
  run(5.0);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(PursuitTest, SaysWhatIsMissing) {
  const auto no_map = pursuit_.step(now_s_, state_, committed_, nullptr);
  ASSERT_TRUE(no_map.report);
  EXPECT_EQ(no_map.report->reason, PlanReason::kNoMap);
  committed_ = Motion();
  const auto no_motion = step();
  ASSERT_TRUE(no_motion.report);
  EXPECT_EQ(no_motion.report->reason, PlanReason::kNoPose);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(PursuitTest, ReplacesAPlanOnlyByOneThatIsMuchBetter) {
  speed_ = 0.3;
  step();
  const double end_s = pursuit_.plan().end_time();
  EXPECT_TRUE(run(3.0).plan.empty());  // as fast, but later
  EXPECT_EQ(asked_.size(), 3u);
  EXPECT_DOUBLE_EQ(asked_[0].driven.end_time(), end_s);
  EXPECT_DOUBLE_EQ(pursuit_.plan().end_time(), end_s);
  speed_ = 0.8;
  EXPECT_FALSE(run(1.0).plan.empty());
  EXPECT_LT(pursuit_.plan().end_time(), end_s);
}

TEST_F(PursuitTest, AFailureToImproveIsNoNews) {
  step();
  reason_ = PlanReason::kNotCertified;
  const auto output = run(1.0);
  ASSERT_TRUE(output.planned);
  EXPECT_FALSE(output.report);
  EXPECT_FALSE(pursuit_.plan().empty());
}

TEST_F(PursuitTest, AnswersARequestAtOnceButNoMoreOftenThanItCanPlan) {
  step();
  run(0.3);
  pursuit_.request();
  const auto asked = step();
  ASSERT_TRUE(asked.planned);
  EXPECT_FALSE(asked.plan.empty());  // better or not
  pursuit_.request();
  run(0.15);
  EXPECT_TRUE(asked_.empty());
  run(0.05);
  EXPECT_EQ(asked_.size(), 1u);
}

TEST_F(PursuitTest, PlansFromTheEndOfARetreat) {
  reason_ = PlanReason::kBackingOut;
  const auto retreat = step();
  ASSERT_FALSE(retreat.plan.empty());
  reason_ = PlanReason::kSolved;
  committed_ = retreat.plan;
  run(1.95);  // the retreat ends 2.5 s after it was planned
  EXPECT_TRUE(asked_.empty());
  EXPECT_FALSE(run(0.1).plan.empty());
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_GE(asked_[0].start_time_s, retreat.plan.end_time() - 1e-6);
  EXPECT_TRUE(asked_[0].driven.empty());
}

TEST_F(PursuitTest, GivesUpAGoalThatStaysOccupied) {
  reason_ = PlanReason::kGoalOccupied;
  committed_ = straight_drive(now_s_, {0.0, 0.0}, 0.0, 30.0, 0.8, kAcceleration);
  EXPECT_EQ(run(rules().occupied_goal_timeout_s - 0.5).ending, Ending::kNone);
  const auto given_up = run(1.0);
  EXPECT_EQ(given_up.ending, Ending::kGoalOccupied);
  EXPECT_TRUE(pursuit_.idle());
  ASSERT_FALSE(given_up.plan.empty());  // brakes along what it is bound to
  EXPECT_LT(given_up.plan.end_time(), now_s_ + 5.0);
}

TEST_F(PursuitTest, AGoalThatBecomesFreeIsNotGivenUp) {
  reason_ = PlanReason::kGoalOccupied;
  run(2.0);
  reason_ = PlanReason::kNoPath;
  run(2.0);
  reason_ = PlanReason::kGoalOccupied;
  EXPECT_EQ(run(2.0).ending, Ending::kNone);
}

TEST_F(PursuitTest, GivesUpWithoutProgress) {
  reason_ = PlanReason::kNoPath;
  EXPECT_EQ(run(rules().goals.timeout_s - 1.0).ending, Ending::kNone);
  EXPECT_EQ(run(2.0).ending, Ending::kNoProgress);
  EXPECT_TRUE(pursuit_.idle());
}

TEST_F(PursuitTest, FollowsASwerveThatLeadsToTheSameGoal) {
  step();
  const Motion plan = pursuit_.plan();
  pursuit_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, 3.0, 0.8, kAcceleration));
  EXPECT_DOUBLE_EQ(pursuit_.plan().end_time(), plan.end_time());
  pursuit_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, kLength_m + 0.2, 0.3, kAcceleration));
  EXPECT_GT(pursuit_.plan().end_time(), plan.end_time());
  EXPECT_FALSE(run(1.0).plan.empty());  // now the former one is much better
}

TEST_F(PursuitTest, FollowsNothingToANewGoalBeforeItIsPlannedTo) {
  pursuit_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, kLength_m, 0.8, kAcceleration));
  EXPECT_TRUE(pursuit_.plan().empty());
}

TEST_F(PursuitTest, GoesToTheFreePlaceNearAnOccupiedGoal) {
  goal_ = Vector2(kLength_m - 0.3, 0.0);
  step();
  state_.pose.position = *goal_;
  EXPECT_EQ(step().ending, Ending::kReached);
}

/// As where a team-mate stood there when the goal was given.
TEST_F(PursuitTest, GoesToTheGoalItselfOnceThatIsFree) {
  goal_ = Vector2(kLength_m - 0.25, 0.0);
  run(0.2);
  goal_.reset();
  const double replan_s = rules().replan_period_s;
  const auto output = run(replan_s + 0.2);
  ASSERT_FALSE(output.plan.empty());
  EXPECT_NEAR(output.plan.end_pose().position.x(), kLength_m, 1e-6);
  goal_ = Vector2(kLength_m - 0.4, 0.0);  // occupied again: the plan at hand may still be driven
  EXPECT_TRUE(run(replan_s + 0.2).plan.empty());
  EXPECT_NEAR(pursuit_.plan().end_pose().position.x(), kLength_m, 1e-6);
}

TEST_F(PursuitTest, StopsAlongWhatIsInForce) {
  committed_ = long_drive(now_s_ - 4.0, 30.0);
  const Motion braking = pursuit_.stop(committed_, now_s_);
  ASSERT_FALSE(braking.empty());
  EXPECT_TRUE(pursuit_.idle());
  const double from_s = braking.start_time();
  EXPECT_NEAR(braking.at(from_s).speed, committed_.at(from_s).speed, 1e-3);
  EXPECT_LT(braking.end_time(), committed_.end_time());
  EXPECT_TRUE(pursuit_.stop(Motion(), now_s_).empty());
}

TEST_F(PursuitTest, NewRulesCountAtOnce) {
  step();
  PursuitRules faster = rules();
  faster.replan_period_s = 0.25;
  pursuit_.set_rules(faster);
  run(1.0);
  EXPECT_EQ(asked_.size(), 4u);
}

}  // namespace
}  // namespace mocha
