// What the executive does with an order of passing.
#include <gtest/gtest.h>

#include "planning/executive/executive_fixture.h"

namespace mocha {
namespace {

using Ending = GoalExecutive::Ending;
using S = ExecutiveState;

class PassingTest : public ExecutiveFixture {
 protected:
  /// ugv2 keeps to the order, and has promised so many moves.
  GoalExecutive::Output run_beside(std::uint32_t moves, double time_s) {
    GoalExecutive::Output last;
    std::vector<PlanQuery> asked;
    std::vector<PassingMessage> said;
    for (const double end_s = now_s_ + time_s - 1e-6; now_s_ < end_s;) {
      hear_promised(moves);
      GoalExecutive::Output output = run(0.25);
      if (output.planned || output.ending != Ending::kNone) last = std::move(output);
      asked.insert(asked.end(), asked_.begin(), asked_.end());
      said.insert(said.end(), said_.begin(), said_.end());
    }
    asked_ = asked;
    said_ = said;
    return last;
  }

  void hear(const PassingInstruction& instruction) { executive_.hear(instruction, now_s_); }

  void park() {
    stand_at({kLength_m, 0.0});
    ASSERT_EQ(step().ending, Ending::kReached);
    ASSERT_EQ(executive_.state(), S::kParked);
  }

  /// Drives what is promised, and no farther.
  bool keeps_promise(const GoalExecutive::Output& output) const {
    return output.plan && output.kind == PlanKind::kInTurn &&
           output.plan->start_time() == committed_.start_time() &&
           output.plan->end_time() == committed_.end_time();
  }

  Vector2 end_of_plan() const { return executive_.plan().end_pose().position; }
};

TEST_F(PassingTest, DrivesTheStretchAndNotToTheGoal) {
  step();
  ASSERT_EQ(executive_.state(), S::kDriving);
  hear(ordered({{0.0, 0.0}, {0.0, 1.0}, {0.0, 2.0}}));
  const auto output = run_beside(0, 0.25);
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_EQ(asked_[0].goal, Vector2(0.0, 2.0));
  EXPECT_FALSE(asked_[0].goal_yaw_rad);
  const std::vector<Vector2> path = {{0.0, 0.0}, {0.0, 1.0}, {0.0, 2.0}};
  EXPECT_EQ(asked_[0].along, path);
  EXPECT_TRUE(asked_[0].driven.empty());
  ASSERT_TRUE(output.plan);
  EXPECT_EQ(output.kind, PlanKind::kInTurn);
  EXPECT_NEAR((end_of_plan() - Vector2(0.0, 2.0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(executive_.state(), S::kDriving);
}

TEST_F(PassingTest, ToTheGoalAnyPathWillDo) {
  EXPECT_EQ(step().kind, PlanKind::kFree);
  EXPECT_TRUE(asked_[0].along.empty());
}

/// The robot keeps its promise meanwhile, and goes on asking for a plan.
TEST_F(PassingTest, WhoIsThroughDrivesWhatItHasPromisedUntilThereIsAPlanToItsGoal) {
  step();
  PassingInstruction instruction = ordered({{0.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}});
  instruction.alone_from = 1;
  hear(instruction);
  step();
  committed_ = executive_.plan();
  reason_ = PlanReason::kBudgetExhausted;
  std::vector<Vector2> goals;
  for (int i = 0; i < 100 && now_s_ < committed_.end_time() - 0.5; ++i) {
    state_.pose = committed_.at(now_s_).pose;
    state_.twist = {committed_.at(now_s_).speed, 0.0};
    const auto output = step();
    EXPECT_TRUE(!output.plan || keeps_promise(output));
    if (output.planned) goals.push_back(query_.goal);
  }
  ASSERT_FALSE(goals.empty());
  EXPECT_EQ(goals.back(), Vector2(kLength_m, 0.0));
  reason_ = PlanReason::kSolved;
  run(3.0);
  EXPECT_NEAR((end_of_plan() - Vector2(kLength_m, 0.0)).norm(), 0.0, 1e-6);
}

TEST_F(PassingTest, WaitsForItsTurnWhereItsPromiseEnds) {
  step();
  hear(ordered({{0.0, 0.0}, {2.0, 0.0}}, {1}));
  EXPECT_TRUE(keeps_promise(step()));
  EXPECT_EQ(executive_.state(), S::kWaiting);
  EXPECT_FALSE(run_beside(0, 4.0).plan);
  EXPECT_TRUE(asked_.empty());
  EXPECT_TRUE(executive_.plan().empty());
  EXPECT_TRUE(run_beside(1, 0.5).plan);
  EXPECT_EQ(asked_.at(0).goal, Vector2(2.0, 0.0));
}

TEST_F(PassingTest, TurnsToWhereItGoesOnWhileItWaits) {
  step();
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}}, {1}));
  run_beside(0, 0.5);
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_EQ(asked_[0].goal, Vector2(0.0, 0.0));
  ASSERT_TRUE(asked_[0].goal_yaw_rad);
  EXPECT_NEAR(*asked_[0].goal_yaw_rad, M_PI / 2.0, 1e-9);
  EXPECT_TRUE(asked_[0].along.empty());
  state_.pose.yaw_rad = M_PI / 2.0;
  committed_ = standing(now_s_, {0.0, 0.0}, M_PI / 2.0);
  EXPECT_TRUE(keeps_promise(step()));
  EXPECT_EQ(executive_.state(), S::kWaiting);
  run_beside(1, 0.5);
  EXPECT_EQ(asked_.at(0).goal, Vector2(0.0, 2.0));
}

TEST_F(PassingTest, TurnsItsTailThereIfThatIsNearer) {
  step();
  hear(ordered({{0.0, 0.0}, {-2.0, 0.6}}, {1}));
  run_beside(0, 0.5);
  ASSERT_EQ(asked_.size(), 1u);
  ASSERT_TRUE(asked_[0].goal_yaw_rad);
  EXPECT_NEAR(*asked_[0].goal_yaw_rad, std::atan2(-0.6, 2.0), 1e-9);
}

TEST_F(PassingTest, PlansBackAsSoonAsItMayOnceItHasPromisedToGetWhereTheWayTurnsBack) {
  step();
  hear(ordered({{0.0, 0.0}, {2.0, 0.0}, {0.0, 0.0}}, {0, 1}));
  ASSERT_TRUE(run_beside(0, 0.25).plan);
  committed_ = executive_.plan();
  state_.twist = {0.3, 0.0};
  state_.pose = committed_.at(now_s_).pose;
  run_beside(0, 0.25);
  for (const PlanQuery& query : asked_) EXPECT_EQ(query.goal, Vector2(2.0, 0.0));
  state_.pose = committed_.at(now_s_).pose;
  run_beside(1, 0.25);
  ASSERT_FALSE(asked_.empty());
  const std::vector<Vector2> back = {{2.0, 0.0}, {0.0, 0.0}};
  EXPECT_EQ(asked_.back().along, back);
  EXPECT_LT(asked_.back().start_time_s, committed_.end_time() - 0.5) << "long before it is there";
}

TEST_F(PassingTest, DoesNotTurnBeforeItStands) {
  step();
  state_.twist = {0.3, 0.0};
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}}, {1}));
  EXPECT_TRUE(keeps_promise(step()));
  EXPECT_EQ(executive_.state(), S::kWaiting);
  EXPECT_FALSE(run_beside(0, 1.0).planned);
  state_.twist = {0.0, 0.0};
  run_beside(0, 0.5);
  EXPECT_TRUE(asked_.at(0).goal_yaw_rad);
}

TEST_F(PassingTest, WaitsAgainWhereTheNextMoveIsNotItsTurn) {
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}, {2.0, 2.0}}, {0, 1}));
  run_beside(0, 0.5);
  committed_ = executive_.plan();
  run_beside(0, 0.25);
  stand_at({0.0, 2.0});
  EXPECT_TRUE(keeps_promise(step()));
  EXPECT_EQ(executive_.state(), S::kWaiting);
  run_beside(1, 0.5);
  EXPECT_EQ(asked_.at(0).goal, Vector2(2.0, 2.0));
  EXPECT_EQ(asked_.at(0).along.front(), Vector2(0.0, 2.0));
}

TEST_F(PassingTest, AStretchThatGetsLongerIsPlannedAnew) {
  hear(ordered({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}, {0, 1}));
  run_beside(0, 0.5);
  EXPECT_EQ(asked_.back().goal, Vector2(1.0, 0.0));
  committed_ = executive_.plan();
  run_beside(1, 0.5);
  ASSERT_FALSE(asked_.empty());
  EXPECT_EQ(asked_.back().goal, Vector2(2.0, 0.0));
  EXPECT_EQ(asked_.back().along.front(), Vector2(0.0, 0.0)) << "it is still on its way";
}

TEST_F(PassingTest, GoesOnToTheGoalAfterwards) {
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}}));
  run_beside(0, 0.5);
  committed_ = executive_.plan();
  run_beside(0, 0.25);
  stand_at({0.0, 2.0});
  const auto output = run_beside(0, 0.5);
  ASSERT_TRUE(output.plan);
  EXPECT_EQ(asked_.back().goal, Vector2(kLength_m, 0.0));
  EXPECT_TRUE(asked_.back().along.empty());
  EXPECT_EQ(output.ending, Ending::kNone);
}

TEST_F(PassingTest, AnOrderThatEndsAtTheGoalEndsThere) {
  hear(ordered({{0.0, 0.0}, {kLength_m, 0.0}}));
  run_beside(0, 0.5);
  committed_ = executive_.plan();
  run_beside(0, 0.25);
  stand_at({kLength_m, 0.0});
  EXPECT_EQ(run_beside(0, 0.5).ending, Ending::kReached);
  EXPECT_EQ(executive_.state(), S::kParked);
}

TEST_F(PassingTest, AGoalOnTheWayIsNotTakenForReached) {
  executive_.take({Goal{{1.0, 0.0}, std::nullopt}}, committed_, now_s_);
  run(0.3);
  hear(ordered({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}, {0, 1}));
  run_beside(0, 0.5);
  committed_ = executive_.plan();
  run_beside(0, 0.25);
  stand_at({1.0, 0.0});
  EXPECT_EQ(run_beside(0, 4.0).ending, Ending::kNone);
  EXPECT_FALSE(executive_.idle());
  EXPECT_EQ(executive_.state(), S::kWaiting);
}

TEST_F(PassingTest, AParkedRobotMakesRoomAndParksAgain) {
  park();
  hear(ordered({{kLength_m, 0.0}, {kLength_m, 2.0}}));
  const auto output = run_beside(0, 0.5);
  EXPECT_EQ(output.ending, Ending::kNone);
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_EQ(asked_[0].goal, Vector2(kLength_m, 2.0));
  committed_ = executive_.plan();
  run_beside(0, 0.25);
  stand_at({kLength_m, 2.0});
  const auto after = run_beside(0, 1.0);
  EXPECT_EQ(executive_.state(), S::kParked);
  EXPECT_TRUE(asked_.empty());
  EXPECT_EQ(after.ending, Ending::kNone) << "it has reached its goal long since";
  EXPECT_TRUE(executive_.plan().empty());
}

TEST_F(PassingTest, AParkedRobotWaitsForItsTurnAndParksAgainWhereThatNeverComes) {
  park();
  hear(ordered({{kLength_m, 0.0}, {kLength_m + 2.0, 0.0}}, {1}));
  run(0.25);
  EXPECT_EQ(executive_.state(), S::kWaiting);
  run(45.0);
  EXPECT_EQ(executive_.state(), S::kParked);
  EXPECT_TRUE(asked_.empty());
}

/// Nobody knows any more who may be in its way there.
TEST_F(PassingTest, AStretchThatIsLeftInItsMidstIsNotDrivenOn) {
  park();
  hear(ordered({{kLength_m, 0.0}, {kLength_m, 2.0}}));
  ASSERT_TRUE(run_beside(0, 0.5).plan);
  bool kept = false;
  for (int i = 0; i < 200; ++i) kept = kept || keeps_promise(step());
  EXPECT_EQ(executive_.state(), S::kParked);
  EXPECT_TRUE(kept);
}

TEST_F(PassingTest, WhoWasToldToStopMakesNoRoom) {
  executive_.drop();
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}}));
  EXPECT_FALSE(run_beside(0, 3.0).plan);
  EXPECT_TRUE(asked_.empty());
  EXPECT_EQ(executive_.state(), S::kIdle);
}

TEST_F(PassingTest, WaitingForOthersIsNoLackOfProgress) {
  hear(ordered({{0.0, 0.0}, {2.0, 0.0}}, {100}));
  const double timeout_s = options().goals.timeout_s;
  std::uint32_t moves = 0;
  for (double waited_s = 0.0; waited_s < timeout_s + 5.0; waited_s += 4.0)
    EXPECT_EQ(run_beside(moves++, 4.0).ending, Ending::kNone);
  EXPECT_EQ(executive_.state(), S::kWaiting);
  executive_.hear(ordered({}), now_s_);
  EXPECT_EQ(run_beside(moves, 0.5).ending, Ending::kNone);
}

TEST_F(PassingTest, ANewGoalEndsTheOrder) {
  hear(ordered({{0.0, 0.0}, {2.0, 0.0}}, {1}));
  run_beside(0, 0.5);
  ASSERT_EQ(executive_.state(), S::kWaiting);
  executive_.take({Goal{{3.0, 0.0}, std::nullopt}}, committed_, now_s_);
  EXPECT_NE(executive_.state(), S::kWaiting);
  run_beside(1, 1.0);
  ASSERT_FALSE(asked_.empty());
  for (const PlanQuery& query : asked_) EXPECT_EQ(query.goal, Vector2(3.0, 0.0));
}

TEST_F(PassingTest, AStopEndsTheOrder) {
  hear(ordered({{0.0, 0.0}, {2.0, 0.0}}, {1}));
  run_beside(0, 0.5);
  executive_.drop();
  run_beside(1, 2.0);
  EXPECT_TRUE(asked_.empty());
  EXPECT_EQ(executive_.state(), S::kIdle);
}

TEST_F(PassingTest, APauseEndsTheOrder) {
  hear(ordered({{0.0, 0.0}, {2.0, 0.0}}, {1}));
  run_beside(0, 0.5);
  executive_.pause();
  run_beside(1, 2.0);
  EXPECT_TRUE(asked_.empty());
  EXPECT_EQ(executive_.state(), S::kPaused);
  executive_.resume();
  run_beside(1, 1.0);
  ASSERT_FALSE(asked_.empty());
  for (const PlanQuery& query : asked_) EXPECT_EQ(query.goal, Vector2(kLength_m, 0.0));
}

TEST_F(PassingTest, TriesAgainAndAgainWhereAStretchCannotBePlanned) {
  reason_ = PlanReason::kPeerConflict;
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}}));
  run_beside(0, 0.25);
  EXPECT_EQ(executive_.state(), S::kBlocked);
  run_beside(0, 3.0);
  EXPECT_NEAR(asked_.size(), 6.0, 1.0);  // once a retry period
  for (const PlanQuery& query : asked_) EXPECT_EQ(query.along.size(), 2u);
  reason_ = PlanReason::kSolved;
  EXPECT_TRUE(run_beside(0, 0.5).plan);
  EXPECT_EQ(executive_.state(), S::kDriving);
}

/// Whatever the planner makes of it: the goal is where it was.
TEST_F(PassingTest, AStretchWithoutAPlanSaysNothingOfTheGoal) {
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}}));
  std::uint32_t moves = 0;
  for (const PlanReason reason : {PlanReason::kNoPath, PlanReason::kGoalOccupied}) {
    reason_ = reason;
    for (int i = 0; i < 4; ++i) {  // another gets on
      EXPECT_EQ(run_beside(++moves, 4.0).ending, Ending::kNone);
      EXPECT_EQ(executive_.state(), S::kBlocked);
    }
  }
}

TEST_F(PassingTest, AMuchQuickerPlanOfTheSameStretchIsTaken) {
  hear(ordered({{0.0, 0.0}, {kLength_m, 0.0}}));
  speed_ = 0.3;
  run_beside(0, 0.5);
  const double end_s = executive_.plan().end_time();
  committed_ = executive_.plan();
  speed_ = 0.8;
  run_beside(0, 2.0);
  EXPECT_LT(executive_.plan().end_time(), end_s - 3.0);
  EXPECT_EQ(executive_.state(), S::kDriving);
  EXPECT_EQ(asked_.back().goal, Vector2(kLength_m, 0.0));
}

TEST_F(PassingTest, PlansAStretchAnewOnRequest) {
  hear(ordered({{0.0, 0.0}, {kLength_m, 0.0}}));
  run_beside(0, 0.5);
  committed_ = executive_.plan();
  executive_.request();
  EXPECT_TRUE(run_beside(0, 0.5).plan);
  EXPECT_EQ(asked_.back().goal, Vector2(kLength_m, 0.0));
}

TEST_F(PassingTest, AStretchThatItDidNotGetToTheEndOfIsPlannedAnew) {
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}}));
  run_beside(0, 0.5);
  stand_at({0.0, 1.0});
  const double end_s = executive_.plan().end_time();
  while (now_s_ < end_s) run_beside(static_cast<std::uint32_t>(now_s_), 0.25);  // others get on
  run_beside(0, 1.5);
  ASSERT_FALSE(asked_.empty());
  EXPECT_EQ(asked_.back().goal, Vector2(0.0, 2.0));
}

/// Both lead over as many moves.
TEST_F(PassingTest, AnotherOrderIsAnotherStretch) {
  hear(ordered({{0.0, 0.0}, {0.0, 2.0}}));
  run_beside(0, 0.5);
  PassingInstruction next = ordered({{0.0, 0.0}, {0.0, -2.0}});
  next.id.number = 2;
  hear(next);
  run_beside(0, 0.5);
  ASSERT_FALSE(asked_.empty());
  EXPECT_EQ(asked_.back().goal, Vector2(0.0, -2.0));
}

TEST_F(PassingTest, ADetourOnTheStretchIsFollowed) {
  hear(ordered({{0.0, 0.0}, {4.0, 0.0}}));
  run_beside(0, 0.5);
  executive_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, 4.2, 0.3, kBraking));
  EXPECT_NEAR(end_of_plan().x(), 4.2, 1e-6);
  executive_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, kLength_m, 0.3, kBraking));
  EXPECT_NEAR(end_of_plan().x(), 4.2, 1e-6) << "the goal is elsewhere";
}

TEST_F(PassingTest, CallsWhereATeamMateIsOnItsWay) {
  reason_ = PlanReason::kPeerConflict;
  stand_ahead("ugv7");
  run(3.9);
  EXPECT_TRUE(said_.empty()) << "there is room beside it";
  run(0.5);
  ASSERT_FALSE(said_.empty());
  const auto* intent = std::get_if<PassingIntent>(&said_.back());
  ASSERT_TRUE(intent);
  EXPECT_EQ(intent->agent, "ugv5");
  EXPECT_TRUE(intent->calls);
  EXPECT_EQ(intent->goal, Vector2(kLength_m, 0.0));
  executive_.drop();
  run(5.0);
  EXPECT_TRUE(said_.empty());
}

TEST_F(PassingTest, CallsNobodyWhereNobodyIsInItsWay) {
  reason_ = PlanReason::kNotCertified;
  run(10.0);
  EXPECT_TRUE(said_.empty());
}

TEST_F(PassingTest, SaysThatItIsParked) {
  park();
  executive_.hear(PassingIntent{"ugv2", 1, 0, true, 0.3, std::nullopt, {}, 0}, now_s_);
  run(0.3);
  ASSERT_FALSE(said_.empty());
  EXPECT_FALSE(std::get<PassingIntent>(said_.back()).goal);
}

}  // namespace
}  // namespace mocha
