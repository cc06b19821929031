// What a robot does that was ordered to pass: from its first instruction to the end of the order.
#include <gtest/gtest.h>

#include "planning/executive/passing_fleet.h"

namespace mocha {
namespace {

using PassingFollowingTest = PassingFleet;

TEST_F(PassingFollowingTest, AnOrderIsFollowedFromWhereItBegins) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.1, 0.0}, {0.0, 1.4}}), now_s_);
  run(kStep_s);
  EXPECT_TRUE(robot.policy->follows());
  ASSERT_TRUE(robot.policy->stretch());
  EXPECT_EQ(robot.policy->stretch()->end(), Vector2(0.0, 1.4));
}

TEST_F(PassingFollowingTest, WhoWillRestElsewhereDoesNotFollow) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.committed = drive_along({{0.0, 0.0}, {1.0, 0.0}}, now_s_, 0.0, 0.8);
  robot.policy->hear(order({{0.0, 0.0}, {0.0, 1.4}}), now_s_);
  run(kStep_s);
  EXPECT_FALSE(robot.policy->follows());
  run(5.0);
  EXPECT_FALSE(robot.policy->follows()) << "nor later";
  robot.policy->hear(order({{1.0, 0.0}, {0.0, 1.4}}), now_s_);
  run(kStep_s);
  EXPECT_TRUE(robot.policy->follows());
}

TEST_F(PassingFollowingTest, WhatIsForOthersOrInTheOwnNameIsNotFollowed) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  PassingInstruction other = order({{0.0, 0.0}, {0.0, 1.4}});
  other.robot = "ugv1";
  robot.policy->hear(other, now_s_);
  PassingInstruction own = order({{0.0, 0.0}, {0.0, 1.4}});
  own.id.leader = "ugv2";
  robot.policy->hear(own, now_s_);
  run(kStep_s);
  EXPECT_FALSE(robot.policy->follows());
}

TEST_F(PassingFollowingTest, AnOrderWhoseBeginningIsLostIsFollowedOnceThatIsHeard) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  PassingInstruction whole = order({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}});
  PassingInstruction rest = whole;
  rest.first = 1;
  rest.part.erase(rest.part.begin());
  robot.policy->hear(rest, now_s_);
  run(kStep_s);
  EXPECT_FALSE(robot.policy->follows());
  PassingInstruction beginning = whole;
  beginning.part.pop_back();
  robot.policy->hear(beginning, now_s_);
  run(kStep_s);
  EXPECT_EQ(robot.policy->stretch()->until, 1u);
  robot.policy->hear(rest, now_s_);
  run(kStep_s);
  EXPECT_EQ(robot.policy->stretch()->until, 2u);
}

TEST_F(PassingFollowingTest, WaitsUntilWhoIsToGoFirstPromises) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  const PassingInstruction instruction = order({{0.0, 0.0}, {1.0, 0.0}}, 2);
  robot.policy->hear(instruction, now_s_);
  robot.policy->hear(intent_of("ugv1", false, instruction.id, 1), now_s_);
  run(1.0);
  EXPECT_TRUE(robot.policy->follows());
  EXPECT_FALSE(robot.policy->stretch());
  robot.policy->hear(intent_of("ugv1", false, {"ugv1", 1, 2}, 2), now_s_);
  run(1.0);
  EXPECT_FALSE(robot.policy->stretch()) << "of another order";
  robot.policy->hear(intent_of("ugv1", false, instruction.id, 2), now_s_);
  run(kStep_s);
  EXPECT_TRUE(robot.policy->stretch());
}

TEST_F(PassingFollowingTest, SaysWhatItHasPromisedAtOnce) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.0, 0.0}, {2.0, 0.0}}), now_s_);
  run(kStep_s);
  EXPECT_EQ(said<PassingIntent>(robot).back().moves, 0u);
  run(kStep_s);  // by then it has promised
  ASSERT_FALSE(robot.said.empty());
  EXPECT_EQ(said<PassingIntent>(robot).back().moves, 1u);
  EXPECT_EQ(said<PassingIntent>(robot).back().follows, (PassingOrderId{"ugv1", 0, 1}));
}

TEST_F(PassingFollowingTest, ANewOrderReplacesTheOneThatIsFollowed) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}, 1), now_s_);
  run(kStep_s);
  EXPECT_FALSE(robot.policy->stretch());
  robot.policy->hear(order({{0.0, 0.0}, {0.0, 1.4}}, 0, 2), now_s_);
  run(kStep_s);
  ASSERT_TRUE(robot.policy->stretch());
  EXPECT_EQ(robot.policy->stretch()->end(), Vector2(0.0, 1.4));
}

TEST_F(PassingFollowingTest, AnotherGoalOrNoneVoidsTheOrder) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}, 1), now_s_);
  run(kStep_s);
  robot.policy->begin_goal();
  EXPECT_FALSE(robot.policy->follows());
  EXPECT_FALSE(robot.policy->stretch());
  run(1.0);
  EXPECT_FALSE(robot.policy->follows());
}

/// What the leader said before it knew of the other goal may come late, or again.
TEST_F(PassingFollowingTest, AnOrderForAnotherGoalIsNotTakenUpAgain) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}, 1), now_s_);
  run(kStep_s);
  robot.policy->begin_goal();
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}, 1), now_s_);
  run(kStep_s);
  EXPECT_FALSE(robot.policy->follows());
  robot.policy->hear(order({{0.0, 0.0}, {0.0, 1.4}}, 0, 2), now_s_);
  run(kStep_s);
  EXPECT_TRUE(robot.policy->follows());
}

TEST_F(PassingFollowingTest, WhoStaysOutForgetsWhatItWasTold) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.takes_part = false;
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}), now_s_);
  robot.policy->hear(intent_of("ugv1", true), now_s_);
  run(1.0);
  robot.takes_part = true;
  run(kStep_s);
  EXPECT_FALSE(robot.policy->follows());
}

TEST_F(PassingFollowingTest, AnOrderWithoutMovesIsOverAtOnceAndSaidSo) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  const PassingInstruction nothing = order({});
  robot.policy->hear(intent_of("ugv1", true), now_s_);
  robot.policy->hear(nothing, now_s_);
  run(kStep_s);
  EXPECT_FALSE(robot.policy->follows());
  ASSERT_FALSE(robot.said.empty());
  EXPECT_EQ(said<PassingIntent>(robot).back().follows, nothing.id);
}

// --- the end ---

TEST_F(PassingFollowingTest, WhoMayGoOnAndCannotLeavesTheOrderAndCallsAnew) {
  Robot& robot = add("ugv2", {0.0, 0.0}, Vector2(4.0, 0.0));
  robot.drives = false;
  add("ugv1", {2.0, 0.0}).takes_part = false;
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}), now_s_);
  run(5.8);
  EXPECT_TRUE(robot.policy->follows());
  EXPECT_FALSE(said<PassingIntent>(robot).back().calls);
  run(0.5);
  EXPECT_FALSE(robot.policy->follows());
  run(2.5);
  ASSERT_FALSE(robot.said.empty());
  EXPECT_TRUE(said<PassingIntent>(robot).back().calls);
}

TEST_F(PassingFollowingTest, AParkedRobotLeavesSuchAnOrderAndDoesNotCall) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.drives = false;
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}), now_s_);
  run(8.0);
  EXPECT_FALSE(robot.policy->follows());
  run(5.0);
  EXPECT_TRUE(robot.said.empty());
}

TEST_F(PassingFollowingTest, AnOrderInWhichNobodyGetsOnIsLeftAtLast) {
  Robot& robot = add("ugv2", {0.0, 0.0}, Vector2(4.0, 0.0));
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}, 1), now_s_);
  run(39.0);
  EXPECT_TRUE(robot.policy->follows());
  run(2.0);
  EXPECT_FALSE(robot.policy->follows());
}

TEST_F(PassingFollowingTest, AnOrderIsLeftSoonWhereTheOneThatIsWaitedForHasLeftIt) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}, 1), now_s_);
  for (int i = 0; i < 9; ++i) {
    robot.policy->hear(intent_of("ugv1", false), now_s_);
    run(1.0);
  }
  EXPECT_TRUE(robot.policy->follows()) << "it may take the order up yet";
  for (int i = 0; i < 2; ++i) {
    robot.policy->hear(intent_of("ugv1", false), now_s_);
    run(1.0);
  }
  EXPECT_FALSE(robot.policy->follows());
}

TEST_F(PassingFollowingTest, WhereAnotherGetsOnNobodyIsStuck) {
  Robot& robot = add("ugv2", {0.0, 0.0}, Vector2(4.0, 0.0));
  const PassingInstruction instruction = order({{0.0, 0.0}, {1.0, 0.0}}, 9);
  robot.policy->hear(instruction, now_s_);
  for (std::uint32_t moves = 0; moves < 5; ++moves) {
    robot.policy->hear(intent_of("ugv1", false, instruction.id, moves), now_s_);
    run(30.0);
    EXPECT_TRUE(robot.policy->follows());
  }
}

/// Moves are counted where they are promised: the drive may take long.
TEST_F(PassingFollowingTest, WhoWaitsForOneThatIsOnItsWayIsNotStuck) {
  Robot& robot = add("ugv2", {0.0, 1.4}, Vector2(-4.0, 0.0));
  Robot& slow = add("ugv1", {4.0, 0.0});
  slow.takes_part = false;
  slow.committed = drive_along({{4.0, 0.0}, {-4.0, 0.0}}, now_s_, M_PI, 0.4);
  const PassingInstruction instruction = order({{0.0, 1.4}, {0.0, 0.0}}, 2);
  robot.policy->hear(instruction, now_s_);
  robot.policy->hear(intent_of("ugv1", false, instruction.id, 1), now_s_);
  ASSERT_GT(slow.committed.end_time(), now_s_ + 20.0);
  run(slow.committed.end_time() - now_s_ + 5.0);
  EXPECT_TRUE(robot.policy->follows());
}

/// It may be silent by then.
TEST_F(PassingFollowingTest, WhatWasPromisedOnceCounts) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  PassingInstruction instruction = order({{0.0, 0.0}, {1.0, 0.0}}, 2);
  instruction.robots.push_back("ugv3");
  instruction.part.front().after.push_back({2, 1});
  robot.policy->hear(instruction, now_s_);
  robot.policy->hear(intent_of("ugv1", false, instruction.id, 2), now_s_);
  run(20.0);
  EXPECT_FALSE(robot.policy->stretch());
  PassingIntent third = intent_of("ugv3", false, instruction.id, 1);
  robot.policy->hear(third, now_s_);
  run(kStep_s);
  EXPECT_TRUE(robot.policy->stretch());
}

TEST_F(PassingFollowingTest, WhoIsThroughSaysSoAsLongAsOthersWait) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  const PassingInstruction instruction = order({{0.0, 0.0}, {1.0, 0.0}});
  robot.policy->hear(instruction, now_s_);
  run(5.0);
  ASSERT_FALSE(robot.policy->follows());
  for (int i = 0; i < 30; ++i) {
    robot.policy->hear(intent_of("ugv1", false, instruction.id, 0), now_s_);
    run(1.0);
    ASSERT_FALSE(robot.said.empty());
    EXPECT_EQ(said<PassingIntent>(robot).back().follows, instruction.id);
    EXPECT_EQ(said<PassingIntent>(robot).back().moves, 1u);
  }
}

/// The robot says that it has promised all its moves: others may wait for those it does not make.
TEST_F(PassingFollowingTest, WhoHasNothingToDoWithOthersAnyMoreIsThrough) {
  Robot& robot = add("ugv2", {-2.0, 0.0}, Vector2(4.0, 0.0));
  PassingInstruction instruction = order({{-2.0, 0.0}, {0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}});
  instruction.alone_from = 1;
  robot.policy->hear(instruction, now_s_);
  while (robot.place(now_s_).x() < -0.7) {
    step();
    ASSERT_TRUE(robot.policy->follows());
  }
  run(1.0);
  EXPECT_FALSE(robot.policy->follows());
  EXPECT_LT(robot.place(now_s_).x(), 1.0) << "on its way";
  ASSERT_FALSE(robot.said.empty());
  EXPECT_EQ(said<PassingIntent>(robot).back().follows, instruction.id);
  EXPECT_EQ(said<PassingIntent>(robot).back().moves, 3U);
}

/// The way on would begin with a turn.
TEST_F(PassingFollowingTest, WhoDrivesBackwardKeepsToItsOrderToTheEnd) {
  Robot& robot = add("ugv2", {-2.0, 0.0}, Vector2(4.0, 0.0));
  robot.drives = false;
  PassingInstruction instruction = order({{-2.0, 0.0}, {0.0, 0.0}, {2.0, 0.0}});
  instruction.alone_from = 1;
  robot.policy->hear(instruction, now_s_);
  run(kStep_s);
  const Motion ahead = straight_drive(now_s_, {-2.0, 0.0}, 0.0, 4.0, 0.8, 0.5);
  const PlanarPath& path = std::get<DrivePhase>(ahead.phases().front()).path;
  robot.committed = Motion(now_s_, {DrivePhase{-1, path}});
  while (robot.place(now_s_).x() < 1.7) {
    step();
    ASSERT_TRUE(robot.policy->follows());
  }
  run(3.0);
  EXPECT_FALSE(robot.policy->follows());
}

TEST_F(PassingFollowingTest, NobodySaysAnythingWhenAllIsOver) {
  add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0));
  ASSERT_TRUE(all_get_there(60.0));
  run(50.0);
  run(10.0);
  for (const Robot& robot : robots_) EXPECT_TRUE(robot.said.empty()) << robot.name;
}

}  // namespace
}  // namespace mocha
