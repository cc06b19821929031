#include <gtest/gtest.h>

#include "planning/executive/executive_fixture.h"
#include "planning/executive/goal_executive.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

using Ending = GoalExecutive::Ending;
using MakingRoomTest = ExecutiveFixture;

TEST_F(MakingRoomTest, AsksForItsWayWhereSomebodyStandsInIt) {
  reason_ = PlanReason::kPeerConflict;
  stand_ahead("ugv7");
  run(1.4);
  EXPECT_TRUE(said_.empty());
  run(2.0);
  ASSERT_GE(said_.size(), 3u);
  EXPECT_EQ(said_.back().agent, "ugv5");
  EXPECT_EQ(said_.back().rank.agent, "ugv5");
  EXPECT_FALSE(said_.back().rank.stuck);
  EXPECT_NEAR(said_.back().path.front().x(), 0.0, 1e-9);
  EXPECT_NEAR(said_.back().path.back().x(), kLength_m, 1e-9);
  executive_.drop();
  run(0.1);
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_TRUE(said_.front().path.empty());  // it withdraws
  run(5.0);
  EXPECT_TRUE(said_.empty());
}

TEST_F(MakingRoomTest, AsksNobodyWhereNobodyIsInItsWay) {
  reason_ = PlanReason::kNotCertified;
  run(10.0);
  EXPECT_TRUE(said_.empty());
}

TEST_F(MakingRoomTest, MakesRoomForAHigherOneAndGoesOnWhenItHasPassed) {
  step();
  const YieldRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  executive_.hear(request, now_s_);
  const auto output = run_while_asked(request, 0.5);
  ASSERT_TRUE(output.planned);
  const Vector2 aside = output.planned->goal.position;
  EXPECT_GT(std::abs(aside.y()), 0.8);
  EXPECT_LT(aside.norm(), 1.5);
  EXPECT_TRUE(output.plan);
  state_.pose.position = aside;
  committed_ = standing(now_s_, aside, 0.0);
  run_while_asked(request, 10.0);  // it plans to the goal again and again, but drives nothing
  EXPECT_GT(asked_.size(), 5u);
  EXPECT_EQ(asked_.back().goal.x(), kLength_m);
  EXPECT_TRUE(said_.empty());
  EXPECT_TRUE(executive_.plan().empty());
  EXPECT_EQ(executive_.state(), ExecutiveState::kWaiting);
  const auto after =
      run_while_asked(way_of("ugv2", {{-3.0, 0.0}, {-4.0, 0.0}}), 1.0);  // it is past
  ASSERT_FALSE(executive_.plan().empty());
  EXPECT_NEAR(executive_.plan().end_pose().position.x(), kLength_m, 1e-6);
  EXPECT_EQ(after.ending, Ending::kNone);
}

TEST_F(MakingRoomTest, WaitingForOthersIsNoLackOfProgress) {
  step();
  const YieldRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  const Vector2 aside = run_while_asked(request, 0.5).planned->goal.position;
  state_.pose.position = aside;
  committed_ = standing(now_s_, aside, 0.0);
  EXPECT_EQ(run_while_asked(request, options().goals.timeout_s + 5.0).ending, Ending::kNone);
  EXPECT_EQ(run(0.5).ending, Ending::kNone);
}

TEST_F(MakingRoomTest, DoesNotMoveForALowerOne) {
  reason_ = PlanReason::kNoPath;
  stand_ahead("ugv7");
  run_while_asked(way_of("ugv7", {{1.0, 0.0}, {-4.0, 0.0}}), 3.0);
  for (const PlanQuery& query : asked_) EXPECT_EQ(query.goal.x(), kLength_m);
  EXPECT_FALSE(said_.empty());
}

TEST_F(MakingRoomTest, StandsStillWhereItIsInNobodysWayButWouldGetThere) {
  state_.pose.position = {0.0, 3.0};
  committed_ = standing(now_s_, {0.0, 3.0}, 0.0);
  const auto output = run_while_asked(way_of("ugv2", {{3.0, -4.0}, {3.0, 4.0}}), 2.0);
  EXPECT_TRUE(executive_.plan().empty());
  EXPECT_LE(asked_.size(), 5u);  // once a retry period
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->reason, PlanReason::kPeerConflict);
  EXPECT_NE(output.report->message.find("ugv2"), std::string::npos);
  run(3.0);  // lapsed
  EXPECT_FALSE(executive_.plan().empty());
}

TEST_F(MakingRoomTest, AsksInTheNameOfWhomItMakesRoomFor) {
  step();
  reason_ = PlanReason::kNoPath;
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      if (x == 0.0 && y == 0.0) continue;
      scene_.peers.push_back(std::make_shared<PeerObstacle>(
          "ugv7", std::make_shared<const Motion>(standing(now_s_ - 5.0, {x, y}, 0.0)), 0.3,
          test::kRoverBraking));
    }
  }
  run_while_asked(way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}}), 4.0);
  ASSERT_FALSE(said_.empty());
  EXPECT_EQ(said_.back().agent, "ugv5");
  EXPECT_EQ(said_.back().rank.agent, "ugv2");
}

TEST_F(MakingRoomTest, LooksForAnotherPullOverPointWhereTheFirstIsOutOfReach) {
  step();
  const YieldRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  const Vector2 first = run_while_asked(request, 0.5).planned->goal.position;
  reason_ = PlanReason::kPeerConflict;  // another robot came in between, and stays
  scene_.peers = {std::make_shared<PeerObstacle>(
      "ugv7", std::make_shared<const Motion>(standing(now_s_ - 5.0, first, 0.0)), 0.3,
      test::kRoverBraking)};
  executive_.request();
  const Vector2 next = run_while_asked(request, 1.5).planned->goal.position;
  EXPECT_GT((next - first).norm(), 0.5);
  EXPECT_GT(std::abs(next.y()), 0.8);
}

TEST_F(MakingRoomTest, WhoCannotGetOutOfTheWaySaysSo) {
  OccupancyGrid grid = free_grid({-0.6, -0.6}, {12.0, 0.6});  // a dead end, the way out ahead
  scene_.static_map = static_map_of(grid);
  step();
  reason_ = PlanReason::kPeerConflict;
  stand_ahead("ugv2");
  run_while_asked(way_of("ugv2", {{9.0, 0.0}, {-0.3, 0.0}}), 4.0);
  ASSERT_FALSE(said_.empty());
  EXPECT_TRUE(said_.back().rank.stuck);
  EXPECT_EQ(said_.back().rank.agent, "ugv5");
  EXPECT_NEAR(said_.back().path.back().x(), kLength_m, 1e-9);
}

TEST_F(MakingRoomTest, MakesRoomWhereItIsParkedButNotWhereItWasToldToStop) {
  state_.pose.position = {kLength_m, 0.0};
  committed_ = standing(now_s_, {kLength_m, 0.0}, 0.0);
  ASSERT_EQ(step().ending, Ending::kReached);
  const YieldRequest request = way_of("ugv9", {{9.0, 0.0}, {-4.0, 0.0}});
  const auto output = run_while_asked(request, 1.0);
  ASSERT_TRUE(output.planned);
  EXPECT_EQ(output.ending, Ending::kNone);
  const Vector2 aside = output.planned->goal.position;
  EXPECT_GT(std::abs(aside.y()), 0.8);
  state_.pose.position = aside;
  run_while_asked(request, 3.0);
  EXPECT_TRUE(asked_.empty());  // it stays there
  executive_.drop();
  state_.pose.position = {kLength_m, 0.0};
  run_while_asked(request, 3.0);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(MakingRoomTest, TriesAgainAndAgainWhereTheOnlyPullOverPointIsOutOfReach) {
  step();
  const YieldRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  reason_ = PlanReason::kNoPath;
  const auto output = run_while_asked(request, 0.5);
  EXPECT_EQ(executive_.state(), ExecutiveState::kPullOverBlocked);
  ASSERT_TRUE(output.plan);
  EXPECT_TRUE(output.plan->empty());  // it brakes
  run_while_asked(request, 3.0);
  EXPECT_NEAR(asked_.size(), 6.0, 1.0);  // once a retry period
  for (const PlanQuery& query : asked_) EXPECT_GT(std::abs(query.goal.y()), 0.8);
  reason_ = PlanReason::kSolved;
  run_while_asked(request, 0.5);
  EXPECT_EQ(executive_.state(), ExecutiveState::kPullingOver);
}

TEST_F(MakingRoomTest, GoesBackToItsPullOverPointWhereItWasPushedAway) {
  step();
  const YieldRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  const Vector2 aside = run_while_asked(request, 0.5).planned->goal.position;
  state_.pose.position = aside;
  committed_ = standing(now_s_, aside, 0.0);
  run_while_asked(request, 1.0);
  ASSERT_EQ(executive_.state(), ExecutiveState::kWaiting);
  state_.pose.position = {0.0, 0.0};
  committed_ = standing(now_s_, {0.0, 0.0}, 0.0);
  run_while_asked(request, 0.5);
  EXPECT_EQ(executive_.state(), ExecutiveState::kPullingOver);
  EXPECT_NEAR((executive_.plan().end_pose().position - aside).norm(), 0.0, 1e-6);
}

TEST_F(MakingRoomTest, PlansAnewToItsPullOverPointOnlyOnRequest) {
  step();
  const YieldRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  const Vector2 aside = run_while_asked(request, 0.5).planned->goal.position;
  committed_ = straight_drive(now_s_, {0.0, 0.0}, M_PI / 2.0, aside.norm(), 0.1, 0.1);
  run_while_asked(request, 1.0);
  EXPECT_TRUE(asked_.empty());
  executive_.request();
  run_while_asked(request, 0.5);
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_EQ(asked_[0].goal, aside);
  EXPECT_EQ(executive_.state(), ExecutiveState::kPullingOver);
}

TEST_F(MakingRoomTest, AParkedRobotForgetsItsPullOverPointWhenTheWayIsClear) {
  state_.pose.position = {kLength_m, 0.0};
  committed_ = standing(now_s_, {kLength_m, 0.0}, 0.0);
  ASSERT_EQ(step().ending, Ending::kReached);
  run_while_asked(way_of("ugv9", {{9.0, 0.0}, {-4.0, 0.0}}), 0.5);
  ASSERT_TRUE(makes_room(executive_.state()));
  run(3.0);  // lapsed
  EXPECT_EQ(executive_.state(), ExecutiveState::kParked);
  EXPECT_TRUE(executive_.plan().empty());
}

TEST_F(MakingRoomTest, WithdrawsWhatItAskedForWhereItHasToMakeRoomItself) {
  reason_ = PlanReason::kNoPath;
  stand_ahead("ugv7");
  run(2.0);
  ASSERT_FALSE(said_.empty());
  run_while_asked(way_of("ugv2", {{0.0, 4.0}, {0.0, -4.0}}), 0.5);
  ASSERT_TRUE(makes_room(executive_.state()));
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_TRUE(said_[0].path.empty());
}

TEST_F(MakingRoomTest, KeepsThePlanAtHandWhereTheNextWouldGetIntoTheWay) {
  goal_ = Vector2(1.5, 0.0);
  step();
  const double end_s = executive_.plan().end_time();
  goal_.reset();
  const YieldRequest request = way_of("ugv2", {{3.0, -4.0}, {3.0, 4.0}});
  executive_.hear(request, now_s_);
  executive_.request();
  EXPECT_FALSE(run_while_asked(request, 1.5).plan);
  EXPECT_GE(asked_.size(), 2u);
  EXPECT_EQ(executive_.state(), ExecutiveState::kDriving);
  EXPECT_EQ(executive_.plan().end_time(), end_s);
}

TEST_F(MakingRoomTest, MakesRoomAgainOnItsWayOn) {
  step();
  const YieldRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  const Vector2 aside = run_while_asked(request, 0.5).planned->goal.position;
  state_.pose.position = aside;
  committed_ = standing(now_s_, aside, 0.0);
  run_while_asked(request, 1.0);
  run_while_asked(way_of("ugv2", {{-3.0, 0.0}, {-4.0, 0.0}}), 0.5);  // it is past
  ASSERT_EQ(executive_.state(), ExecutiveState::kDriving);
  run_while_asked(way_of("ugv3", {{3.0, -4.0}, {3.0, 4.0}}), 0.5);
  EXPECT_EQ(executive_.state(), ExecutiveState::kWaiting);
}

TEST_F(MakingRoomTest, NewOptionsCountAtOnce) {
  step();
  GoalExecutiveOptions tolerant = options();
  tolerant.goals.tolerance_m = 2.0;
  executive_.set_options(tolerant, default_options());
  run_while_asked(way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}}), 0.5);
  for (const PlanQuery& query : asked_) EXPECT_EQ(query.goal.y(), 0.0);  // it stays where it is
  EXPECT_EQ(executive_.state(), ExecutiveState::kWaiting);
}

TEST_F(MakingRoomTest, ForgetsItsGoalsWhereSomethingElseStopsIt) {
  run(1.0);
  executive_.drop();
  EXPECT_TRUE(executive_.idle());
  EXPECT_TRUE(executive_.plan().empty());
  const YieldRequest request = way_of("ugv9", {{9.0, 0.0}, {-4.0, 0.0}});
  EXPECT_FALSE(run_while_asked(request, 3.0).plan);
  EXPECT_TRUE(asked_.empty());
  executive_.take({Goal{{0.0, 0.0}, std::nullopt}}, committed_, now_s_);
  ASSERT_EQ(step().ending, Ending::kReached);  // and is parked there
  executive_.drop();
  EXPECT_FALSE(run_while_asked(request, 3.0).plan) << "makes room";
  EXPECT_TRUE(asked_.empty());
}

}  // namespace
}  // namespace mocha
