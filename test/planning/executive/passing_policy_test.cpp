#include "planning/executive/passing_policy.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "planning/executive/passing_fleet.h"

namespace mocha {
namespace {

using PassingPolicyTest = PassingFleet;

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
