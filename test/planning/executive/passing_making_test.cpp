// While an order is being made, and where two make one at the same time.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "planning/executive/executive_fixture.h"
#include "planning/executive/passing_fleet.h"

namespace mocha {
namespace {

using S = ExecutiveState;

PassingIntent call_of(const std::string& agent) {
  return {agent, 1, 0, true, 0.3, Vector2(9.0, 9.0), {}, 0};
}

class PassingMakingTest : public PassingFleet {
 protected:
  bool makes_orders(const Robot& robot) const { return !said<PassingInstruction>(robot).empty(); }
};

TEST_F(PassingMakingTest, ARobotHoldsFromTheFirstCallUntilAnOrderMayHaveCome) {
  Robot& robot = add("ugv2", {-3.0, 0.0}, Vector2(-1.0, 0.0));
  run(1.0);
  EXPECT_FALSE(robot.policy->holds());
  std::vector<bool> held;
  for (int i = 0; i < 40; ++i) {
    robot.policy->hear(call_of("ugv1"), now_s_);
    run(kStep_s);
    held.push_back(robot.policy->holds());
  }
  EXPECT_TRUE(held.front());
  EXPECT_NEAR(std::count(held.begin(), held.end(), true), 12, 1);
  EXPECT_FALSE(held.back()) << "a robot that calls in vain holds nobody up for long";
}

TEST_F(PassingMakingTest, WhoKeepsToAnOrderDoesNotHold) {
  Robot& robot = add("ugv2", {-3.0, 0.0}, Vector2(-1.0, 0.0));
  robot.policy->hear(order({{-3.0, 0.0}, {-1.0, 0.0}}), now_s_);
  robot.policy->hear(call_of("ugv1"), now_s_);
  run(kStep_s);
  ASSERT_TRUE(robot.policy->follows());
  EXPECT_FALSE(robot.policy->holds());
}

/// Neither hears the other's calls.
TEST_F(PassingMakingTest, OfTwoThatMakeAnOrderAtTheSameTimeTheLowerRankGivesItsOwnUp) {
  Robot& first = add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
  Robot& second = add("ugv2", {3.0, 0.0}, Vector2(-4.0, 0.0));
  loss_ = 1.0;
  const auto tell = [&](const Robot& from, Robot& to, bool calls) {
    PassingIntent intent = call_of(from.name);
    intent.calls = calls;
    intent.goal = from.goal;
    to.policy->hear(intent, now_s_);
  };
  while (!makes_orders(first) || !makes_orders(second)) {
    tell(first, second, false);
    tell(second, first, false);
    step();
    ASSERT_LT(now_s_, 1.7e9 + 5.0);
  }
  loss_ = 0.0;
  run(1.0);
  EXPECT_TRUE(first.policy->follows());
  EXPECT_FALSE(second.policy->follows()) << "where it has begun, the other's order does not";
  run(4.0);
  EXPECT_FALSE(makes_orders(second));
  EXPECT_TRUE(all_get_there(60.0));
}

TEST_F(PassingMakingTest, AnOldOrderOfAHigherRankIsNoRival) {
  Robot& first = add("ugv1", {3.0, 0.0});
  Robot& second = add("ugv2", {-3.0, 0.0}, Vector2(4.0, 0.0));
  PassingIntent intent{"ugv1", 1, 0, false, 0.3, std::nullopt, {"ugv1", 1, 1}, 3};
  for (int i = 0; i < 30; ++i) {
    second.policy->hear(intent, now_s_);
    step();
  }
  EXPECT_FALSE(told(second, first.name).empty());
}

class HoldingTest : public ExecutiveFixture {};

TEST_F(HoldingTest, DrivesWhatItHasPromisedAndThenOnToItsGoal) {
  step();
  ASSERT_EQ(executive_.state(), S::kDriving);
  committed_ = executive_.plan();
  state_.twist = {0.5, 0.0};
  executive_.hear(call_of("ugv2"), now_s_);
  const auto held = step();
  ASSERT_TRUE(held.plan);
  EXPECT_EQ(held.kind, PlanKind::kInTurn);
  EXPECT_EQ(held.plan->end_time(), committed_.end_time());
  EXPECT_EQ(executive_.state(), S::kWaiting);
  for (int i = 0; i < 60 && executive_.state() == S::kWaiting; ++i) step();
  run(0.5);
  EXPECT_EQ(executive_.state(), S::kDriving);
  EXPECT_NEAR((executive_.plan().end_pose().position - Vector2(kLength_m, 0.0)).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace mocha
