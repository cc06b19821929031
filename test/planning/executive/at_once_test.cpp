// What ends at once: goals that are replaced, paused, or that no path leads to.
#include "planning/executive/executive_fixture.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

using Ending = GoalExecutive::Ending;
using S = ExecutiveState;

class AtOnceTest : public ExecutiveFixture {
 protected:
  /// At 0.9 m/s along x, on a promise of 30 m.
  void drive() {
    step();
    committed_ = long_drive(now_s_ - 4.0, 30.0);
  }

  void take(const Vector2& goal) {
    executive_.take({Goal{goal, std::nullopt}}, committed_, now_s_);
  }

  Vector2 here() const { return committed_.position(now_s_); }

  void brake() { committed_ = with_brake(committed_, now_s_, now_s_ + 0.1, rover().braking()); }

  /// Says that there is nothing to drive to.
  static bool stops(const GoalExecutive::Output& output) {
    return output.plan && output.plan->empty();
  }
};

TEST_F(AtOnceTest, AGoalBehindIsPlannedToFromTheBraking) {
  drive();
  take(here() - Vector2(3.0, 0.0));
  EXPECT_EQ(executive_.state(), S::kBraking);
  asked_.clear();
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(stops(step())) << "and says so until it brakes";
  EXPECT_TRUE(asked_.empty());
  brake();
  EXPECT_TRUE(stops(step()));
  const auto planned = step();
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_LT(asked_[0].committed.end_time(), now_s_ + 3.0);
  ASSERT_TRUE(planned.plan);
  EXPECT_FALSE(planned.plan->empty());
  EXPECT_EQ(executive_.state(), S::kDriving);
}

TEST_F(AtOnceTest, AGoalAheadIsPlannedToWhileItRolls) {
  drive();
  for (const double angle_rad : {0.0, 1.1, -1.1}) {
    take(here() + Vector2(2.0, 0.0) + 5.0 * Vector2(std::cos(angle_rad), std::sin(angle_rad)));
    EXPECT_EQ(executive_.state(), S::kPlanning) << angle_rad;
    const auto planned = run(0.2);
    ASSERT_TRUE(planned.plan);
    EXPECT_FALSE(planned.plan->empty());
  }
  for (const double angle_rad : {1.7, -1.7, 3.1}) {
    take(here() + 5.0 * Vector2(std::cos(angle_rad), std::sin(angle_rad)));
    EXPECT_EQ(executive_.state(), S::kBraking) << angle_rad;
  }
}

TEST_F(AtOnceTest, AGoalThatIsTooNearToStopBeforeItIsOneBehind) {
  drive();
  take(here() + Vector2(0.4, 0.0));
  EXPECT_EQ(executive_.state(), S::kBraking);
}

TEST_F(AtOnceTest, ARobotThatIsAboutToSetOffElsewhereIsHeldBackFirst) {
  step();
  take({0.0, 4.0});
  asked_.clear();
  EXPECT_TRUE(stops(step()));
  EXPECT_TRUE(asked_.empty());
  EXPECT_TRUE(step().planned);
}

TEST_F(AtOnceTest, AGoalWithoutAPlanEndsTheDriveToTheOneBefore) {
  drive();
  take(here() + Vector2(9.0, 1.0));
  reason_ = PlanReason::kNotCertified;
  EXPECT_TRUE(stops(step()));
  EXPECT_FALSE(run(3.0).plan) << "is said once";
}

TEST_F(AtOnceTest, GivenUpThereIsNothingToDriveTo) {
  reason_ = PlanReason::kNotCertified;
  const auto last = run(options().goals.timeout_s + 1.0);
  EXPECT_EQ(last.ending, Ending::kNoProgress);
  EXPECT_TRUE(stops(last));
}

// --- pause ---

TEST_F(AtOnceTest, APausedRobotKeepsItsGoalAndPlansAnewWhenItIsResumed) {
  drive();
  executive_.pause();
  EXPECT_EQ(executive_.state(), S::kPaused);
  EXPECT_FALSE(executive_.idle());
  brake();
  state_.pose = committed_.end_pose();
  EXPECT_EQ(run(2.0 * options().goals.timeout_s).ending, Ending::kNone) << "pauses are no delays";
  EXPECT_TRUE(asked_.empty());
  executive_.resume();
  EXPECT_TRUE(run(0.2).plan);
  EXPECT_EQ(asked_.at(0).goal, Vector2(kLength_m, 0.0));
  EXPECT_EQ(executive_.state(), S::kDriving);
}

TEST_F(AtOnceTest, ResumedBeforeItBrakesItPlansFromTheBraking) {
  drive();
  executive_.pause();
  executive_.resume();
  EXPECT_TRUE(stops(run(0.3)) || asked_.empty());
  brake();
  run(0.15);
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_LT(asked_[0].committed.end_time(), now_s_ + 3.0);
}

TEST_F(AtOnceTest, APauseLastsWhateverGoalsAreGivenOrCancelled) {
  executive_.pause();
  take({3.0, 0.0});
  run(1.0);
  EXPECT_TRUE(asked_.empty());
  executive_.drop();
  EXPECT_TRUE(executive_.idle());
  EXPECT_EQ(executive_.state(), S::kPaused);
  take({4.0, 0.0});
  run(1.0);
  EXPECT_TRUE(asked_.empty());
  executive_.resume();
  run(1.0);
  EXPECT_EQ(asked_.at(0).goal, Vector2(4.0, 0.0));
}

TEST_F(AtOnceTest, ResumedWithoutAGoalItHasNothingToDo) {
  executive_.drop();
  executive_.pause();
  executive_.resume();
  EXPECT_EQ(executive_.state(), S::kIdle);
  executive_.resume();
  EXPECT_EQ(executive_.state(), S::kIdle);
}

TEST_F(AtOnceTest, APausedRobotMakesNoRoomAndAsksForNone) {
  step();
  executive_.pause();
  stand_ahead("ugv7");
  for (int i = 0; i < 10; ++i) {
    executive_.hear(ordered({{0.0, 0.0}, {0.0, 2.0}}), now_s_);
    hear_promised(0);
    run(0.5);
    EXPECT_TRUE(asked_.empty());
    EXPECT_TRUE(said_.empty());
  }
  EXPECT_EQ(executive_.state(), S::kPaused);
}

// --- no path ---

TEST_F(AtOnceTest, AGoalToWhichNoPathLeadsIsSaidSoAtOnceAndGivenUpSoon) {
  reason_ = PlanReason::kNoPath;
  const auto first = step();
  ASSERT_TRUE(first.report);
  EXPECT_EQ(first.report->reason, PlanReason::kNoPath);
  EXPECT_EQ(executive_.state(), S::kUnreachable);
  EXPECT_EQ(run(options().unreachable_timeout_s - 0.5).ending, Ending::kNone);
  const auto last = run(1.0);
  EXPECT_EQ(last.ending, Ending::kUnreachable);
  EXPECT_TRUE(stops(last));
  EXPECT_TRUE(executive_.idle());
}

TEST_F(AtOnceTest, SomebodyWhoCrossesDoesNotEndAGoal) {
  for (int i = 0; i < 3; ++i) {
    reason_ = PlanReason::kNoPath;
    EXPECT_EQ(run(options().unreachable_timeout_s - 1.0).ending, Ending::kNone);
    reason_ = PlanReason::kPeerConflict;
    EXPECT_EQ(run(1.0).ending, Ending::kNone);
    EXPECT_EQ(executive_.state(), S::kBlocked);
  }
  reason_ = PlanReason::kSolved;
  EXPECT_TRUE(run(1.0).plan);
}

TEST_F(AtOnceTest, WithAPlanAtHandALackOfPathsIsNoEnd) {
  step();
  reason_ = PlanReason::kNoPath;
  executive_.request();
  EXPECT_EQ(run(options().unreachable_timeout_s + 1.0).ending, Ending::kNone);
  EXPECT_EQ(executive_.state(), S::kDriving);
}

}  // namespace
}  // namespace mocha
