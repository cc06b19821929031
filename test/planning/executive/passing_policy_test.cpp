#include "planning/executive/passing_policy.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "planning/executive/passing_fleet.h"

namespace mocha {
namespace {

using PassingPolicyTest = PassingFleet;

PassingIntent intent_of(const std::string& agent, bool calls, PassingOrderId follows = {},
                        std::uint32_t moves = 0) {
  return {agent, 1, 0, calls, 0.3, std::nullopt, std::move(follows), moves};
}

/// What ugv1 orders ugv2 to do: straight moves from place to place, the first after so many of its
/// own.
PassingInstruction order(const std::vector<Vector2>& places, std::uint32_t after = 0,
                         std::uint32_t number = 1) {
  PassingInstruction instruction{{"ugv1", 1, number}, "ugv2", {"ugv1", "ugv2"}, 0, 0, 0, {}};
  for (std::size_t i = 1; i < places.size(); ++i)
    instruction.part.push_back({{places[i - 1], places[i]}, {}});
  if (after > 0) instruction.part.front().after = {{0, after}};
  instruction.turns = static_cast<std::uint32_t>(instruction.part.size());
  instruction.alone_from = instruction.turns;
  return instruction;
}

// --- calls ---

TEST_F(PassingPolicyTest, NobodyCallsWhileNobodyIsImpeded) {
  Robot& ahead = add("ugv1", {1.0, 0.0}, Vector2(4.0, 0.0));
  Robot& behind = add("ugv2", {-3.0, 0.0}, Vector2(-1.0, 0.0));
  run(10.0);
  EXPECT_TRUE(ahead.said.empty());
  EXPECT_TRUE(behind.said.empty());
  EXPECT_FALSE(ahead.policy->follows());
}

TEST_F(PassingPolicyTest, WhoIsImpededCallsAndAllAboutItSayWhereTheyAreToGet) {
  Robot& impeded = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  Robot& parked = add("ugv2", {3.0, 0.0});
  Robot& behind = add("ugv3", {-4.4, 0.0}, Vector2(-4.4, 0.0));
  run(0.9);
  EXPECT_TRUE(impeded.said.empty());
  run(0.5);
  ASSERT_FALSE(impeded.said.empty());
  EXPECT_TRUE(said<PassingIntent>(impeded).back().calls);
  EXPECT_EQ(said<PassingIntent>(impeded).back().goal, Vector2(4.0, 0.0));
  for (const Robot* robot : {&parked, &behind}) {
    ASSERT_FALSE(robot->said.empty()) << robot->name;
    const PassingIntent intent = said<PassingIntent>(*robot).back();
    EXPECT_EQ(intent.agent, robot->name);
    EXPECT_FALSE(intent.calls);
    EXPECT_EQ(intent.goal, robot->goal);
    EXPECT_NEAR(intent.radius_m, 0.3, 0.05);
  }
}

TEST_F(PassingPolicyTest, IsSaidAFewTimesASecond) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  std::size_t times = 0;
  for (int i = 0; i < 30; ++i) {
    robot.policy->hear(intent_of("ugv1", true), now_s_);
    run(kStep_s);
    times += robot.said.size();
  }
  EXPECT_GE(times, 7u);
  EXPECT_LE(times, 11u);
}

// --- orders ---

TEST_F(PassingPolicyTest, TwoPassEachOtherByTheSiding) {
  add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0));
  EXPECT_TRUE(all_get_there(60.0));
}

TEST_F(PassingPolicyTest, AParkedOneMakesRoomForTwo) {
  add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  Robot& parked = add("ugv2", {0.0, 0.0});
  add("ugv3", {3.0, 0.0}, Vector2(-4.0, 0.0));
  EXPECT_TRUE(all_get_there(200.0));
  EXPECT_GT((parked.place(now_s_) - Vector2(4.0, 0.0)).norm(), 0.9);
  EXPECT_GT((parked.place(now_s_) - Vector2(-4.0, 0.0)).norm(), 0.9);
}

TEST_F(PassingPolicyTest, TheyPassThoughEveryOtherMessageGetsLost) {
  loss_ = 0.5;
  add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv2", {0.0, 1.4});
  add("ugv3", {3.0, 0.0}, Vector2(-4.0, 0.0));
  EXPECT_TRUE(all_get_there(250.0));
}

TEST_F(PassingPolicyTest, TheyPassHoweverSlowTheyDrive) {
  speed_ = 0.2;
  Robot& first = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  Robot& second = add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0));
  std::set<std::uint32_t> orders;
  for (int i = 0; i < 1500 && !(first.is_there(now_s_) && second.is_there(now_s_)); ++i) {
    run(kStep_s);
    for (const PassingInstruction& each : said<PassingInstruction>(first))
      orders.insert(each.id.number);
  }
  EXPECT_TRUE(first.is_there(now_s_) && second.is_there(now_s_));
  EXPECT_EQ(orders.size(), 1u) << "the first order leads them all the way";
  EXPECT_TRUE(said<PassingInstruction>(second).empty());
}

TEST_F(PassingPolicyTest, TheCallerOfTheHighestRankLeads) {
  Robot& first = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  Robot& second = add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0));
  run(4.0);
  EXPECT_FALSE(said<PassingInstruction>(first).empty());
  EXPECT_TRUE(said<PassingInstruction>(second).empty());
  EXPECT_EQ(said<PassingIntent>(second).back().follows.leader, "ugv1");
  EXPECT_EQ(said<PassingIntent>(first).back().follows, said<PassingIntent>(second).back().follows);
}

TEST_F(PassingPolicyTest, ThePriorityGoesBeforeTheName) {
  Robot& first = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0), 0);
  Robot& second = add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0), 1);
  run(4.0);
  EXPECT_TRUE(said<PassingInstruction>(first).empty());
  EXPECT_FALSE(said<PassingInstruction>(second).empty());
}

TEST_F(PassingPolicyTest, WhoDoesNotCallDoesNotLeadWhateverItsRank) {
  Robot& parked = add("ugv1", {0.0, 0.0});
  Robot& caller = add("ugv2", {-3.0, 0.0}, Vector2(4.0, 0.0));
  run(5.0);
  EXPECT_TRUE(said<PassingInstruction>(parked).empty());
  EXPECT_FALSE(said<PassingInstruction>(caller).empty());
}

TEST_F(PassingPolicyTest, ALowerCallerWaitsForTheHigherAsLongAsThatCalls) {
  Robot& robot = add("ugv2", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv1", {3.0, 0.0}).takes_part = false;
  for (int i = 0; i < 20; ++i) {
    robot.policy->hear(intent_of("ugv1", true), now_s_);
    run(0.5);
    EXPECT_TRUE(said<PassingInstruction>(robot).empty());
  }
  robot.policy->hear(intent_of("ugv1", false), now_s_);
  run(0.5);
  EXPECT_FALSE(said<PassingInstruction>(robot).empty());
}

TEST_F(PassingPolicyTest, InstructionsAreRepeatedUntilTheyAreFollowedAndThenMadeAnew) {
  Robot& leader = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv2", {3.0, 0.0}).takes_part = false;
  std::map<std::uint32_t, int> times;
  for (int i = 0; i < 60; ++i) {
    leader.policy->hear(intent_of("ugv2", false), now_s_);
    run(kStep_s);
    for (const PassingInstruction& each : told(leader, "ugv2")) {
      ++times[each.id.number];
    }
  }
  ASSERT_GE(times.size(), 1u);
  EXPECT_GT(times.begin()->second, 3);
}

TEST_F(PassingPolicyTest, WhatIsPromisedIsNotSaidAgain) {
  Robot& leader = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv2", {3.0, 0.0}).takes_part = false;
  leader.policy->hear(intent_of("ugv2", false), now_s_);
  std::vector<PassingInstruction> instructions;
  for (int i = 0; i < 30 && instructions.empty(); ++i) {
    leader.policy->hear(intent_of("ugv2", false), now_s_);
    run(kStep_s);
    instructions = told(leader, "ugv2");
  }
  ASSERT_FALSE(instructions.empty());
  const PassingInstruction whole = instructions.front();
  ASSERT_GE(whole.turns, 2u);
  EXPECT_EQ(whole.first, 0u);
  leader.policy->hear(intent_of("ugv2", false, whole.id, 1), now_s_);
  run(0.5);
  ASSERT_FALSE(told(leader, "ugv2").empty());
  EXPECT_EQ(told(leader, "ugv2").back().first, 1u);
  leader.policy->hear(intent_of("ugv2", false, whole.id, whole.turns), now_s_);
  run(0.5);
  EXPECT_TRUE(told(leader, "ugv2").empty());
}

TEST_F(PassingPolicyTest, WhoDoesNotTakePartIsPassedBy) {
  Robot& robot = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  Robot& stands = add("ugv2", {0.0, 1.4});
  add("ugv3", {3.0, 0.0}, Vector2(-4.0, 0.0));
  stands.takes_part = false;
  EXPECT_FALSE(all_get_there(20.0)) << "the siding is taken";
  EXPECT_TRUE(stands.said.empty());
  for (const PassingInstruction& each : said<PassingInstruction>(robot))
    EXPECT_EQ(std::count(each.robots.begin(), each.robots.end(), "ugv2"), 0);
}

// --- who follows ---

TEST_F(PassingPolicyTest, AnOrderIsFollowedFromWhereItBegins) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.1, 0.0}, {0.0, 1.4}}), now_s_);
  run(kStep_s);
  EXPECT_TRUE(robot.policy->follows());
  ASSERT_TRUE(robot.policy->stretch());
  EXPECT_EQ(robot.policy->stretch()->end(), Vector2(0.0, 1.4));
}

TEST_F(PassingPolicyTest, WhoWillRestElsewhereDoesNotFollow) {
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

TEST_F(PassingPolicyTest, WhatIsForOthersOrInTheOwnNameIsNotFollowed) {
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

TEST_F(PassingPolicyTest, AnOrderWhoseBeginningIsLostIsFollowedOnceThatIsHeard) {
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

TEST_F(PassingPolicyTest, WaitsUntilWhoIsToGoFirstPromises) {
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

TEST_F(PassingPolicyTest, SaysWhatItHasPromisedAtOnce) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.0, 0.0}, {2.0, 0.0}}), now_s_);
  run(kStep_s);
  EXPECT_EQ(said<PassingIntent>(robot).back().moves, 0u);
  run(kStep_s);  // by then it has promised
  ASSERT_FALSE(robot.said.empty());
  EXPECT_EQ(said<PassingIntent>(robot).back().moves, 1u);
  EXPECT_EQ(said<PassingIntent>(robot).back().follows, (PassingOrderId{"ugv1", 0, 1}));
}

TEST_F(PassingPolicyTest, ANewOrderReplacesTheOneThatIsFollowed) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}, 1), now_s_);
  run(kStep_s);
  EXPECT_FALSE(robot.policy->stretch());
  robot.policy->hear(order({{0.0, 0.0}, {0.0, 1.4}}, 0, 2), now_s_);
  run(kStep_s);
  ASSERT_TRUE(robot.policy->stretch());
  EXPECT_EQ(robot.policy->stretch()->end(), Vector2(0.0, 1.4));
}

TEST_F(PassingPolicyTest, AnotherGoalOrNoneVoidsTheOrder) {
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
TEST_F(PassingPolicyTest, AnOrderForAnotherGoalIsNotTakenUpAgain) {
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

TEST_F(PassingPolicyTest, WhoStaysOutForgetsWhatItWasTold) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.takes_part = false;
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}), now_s_);
  robot.policy->hear(intent_of("ugv1", true), now_s_);
  run(1.0);
  robot.takes_part = true;
  run(kStep_s);
  EXPECT_FALSE(robot.policy->follows());
}

TEST_F(PassingPolicyTest, AnOrderWithoutMovesIsOverAtOnceAndSaidSo) {
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

TEST_F(PassingPolicyTest, WhoMayGoOnAndCannotLeavesTheOrderAndCallsAnew) {
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

TEST_F(PassingPolicyTest, AParkedRobotLeavesSuchAnOrderAndDoesNotCall) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.drives = false;
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}), now_s_);
  run(8.0);
  EXPECT_FALSE(robot.policy->follows());
  run(5.0);
  EXPECT_TRUE(robot.said.empty());
}

TEST_F(PassingPolicyTest, AnOrderInWhichNobodyGetsOnIsLeftAtLast) {
  Robot& robot = add("ugv2", {0.0, 0.0}, Vector2(4.0, 0.0));
  robot.policy->hear(order({{0.0, 0.0}, {1.0, 0.0}}, 1), now_s_);
  run(39.0);
  EXPECT_TRUE(robot.policy->follows());
  run(2.0);
  EXPECT_FALSE(robot.policy->follows());
}

TEST_F(PassingPolicyTest, AnOrderIsLeftSoonWhereTheOneThatIsWaitedForHasLeftIt) {
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

TEST_F(PassingPolicyTest, WhereAnotherGetsOnNobodyIsStuck) {
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
TEST_F(PassingPolicyTest, WhoWaitsForOneThatIsOnItsWayIsNotStuck) {
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
TEST_F(PassingPolicyTest, WhatWasPromisedOnceCounts) {
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

TEST_F(PassingPolicyTest, WhoIsThroughSaysSoAsLongAsOthersWait) {
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

/// It is through for the others, too, who may wait for what it has not driven yet.
TEST_F(PassingPolicyTest, WhoHasNothingToDoWithOthersAnyMoreIsThrough) {
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

TEST_F(PassingPolicyTest, NobodySaysAnythingWhenAllIsOver) {
  add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0));
  ASSERT_TRUE(all_get_there(60.0));
  run(50.0);
  run(10.0);
  for (const Robot& robot : robots_) EXPECT_TRUE(robot.said.empty()) << robot.name;
}

// --- strangers ---

TEST_F(PassingPolicyTest, WhoIsNoTeamMateIsNoPartOfAnOrder) {
  Robot& leader = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0));
  for (int i = 0; i < 8; ++i) {
    leader.policy->hear(intent_of("stranger", false), now_s_);
    run(0.5);
    for (const PassingInstruction& each : said<PassingInstruction>(leader)) {
      EXPECT_NE(each.robot, "stranger");
      EXPECT_EQ(each.robots.size(), 2u);
    }
  }
  EXPECT_TRUE(leader.policy->follows());
}

TEST_F(PassingPolicyTest, HearsNothingInItsOwnName) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(intent_of("ugv2", true), now_s_);
  run(1.0);
  EXPECT_TRUE(robot.said.empty());
}

TEST_F(PassingPolicyTest, WhatIsNotHeardAnyMoreLapses) {
  Robot& robot = add("ugv2", {0.0, 0.0});
  robot.policy->hear(intent_of("ugv1", true), now_s_);
  run(1.4);
  EXPECT_FALSE(robot.said.empty());
  run(0.3);
  run(1.0);
  EXPECT_TRUE(robot.said.empty());
}

TEST_F(PassingPolicyTest, AFloodOfNamesDoesNotSilenceWhoWasHeardBefore) {
  Robot& leader = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0));
  run(1.3);
  for (int i = 0; i < 2000; ++i)
    leader.policy->hear(intent_of("a" + std::to_string(i), false), now_s_);
  run(2.0);
  EXPECT_FALSE(said<PassingInstruction>(leader).empty());
  EXPECT_TRUE(leader.policy->follows());
}

TEST_F(PassingPolicyTest, WhereManyAreAboutAsManyPassAsAnOrderCanHold) {
  Robot& leader = add("ugv01", {-3.0, 0.0}, Vector2(4.0, 0.0));
  add("ugv02", {3.0, 0.0}, Vector2(-4.0, 0.0));
  for (int i = 0; i < 40; ++i) {  // far away
    Robot& robot = add("ugv" + std::to_string(10 + i), {100.0 + 2.0 * i, 0.0});
    robot.drives = false;
  }
  run(4.0);
  EXPECT_TRUE(leader.policy->follows());
  for (const PassingInstruction& each : said<PassingInstruction>(leader))
    EXPECT_LE(each.robots.size(), kMostPassing);
}

}  // namespace
}  // namespace mocha
