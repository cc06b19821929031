#include "planning/executive/yield_policy.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

using E = ExecutiveEvent;

constexpr double kNow_s = 1.7e9;
constexpr double kTolerance_m = 0.15;

/// ugv5 in an open place, with ugv2 asking for the way along the x axis.
class YieldPolicyTest : public ::testing::Test {
 protected:
  void hear(const std::string& agent, std::vector<Vector2> path, double now_s = kNow_s) {
    policy_.hear({agent, 1, {false, 0, agent}, 0.3, 1.0, std::move(path)}, now_s);
  }
  void stand(const std::string& agent, const Vector2& place) {
    scene_.peers = {std::make_shared<PeerObstacle>(
        agent, std::make_shared<const Motion>(standing(kNow_s - 5.0, place, 0.0)), 0.3,
        test::kRoverBraking)};
  }
  std::optional<YieldAdvice> advise(const RobotIntent& intent, const Vector2& stop) {
    return policy_.advise(
        intent, stop, [this](const auto&) { return scene_; }, kNow_s);
  }
  std::optional<YieldAdvice> advise(const RobotIntent& intent) {
    return advise(intent, intent.state.pose.position);
  }
  static RobotIntent stays(const Vector2& place) {
    RobotIntent intent;
    intent.state.pose.position = place;
    return intent;
  }

  YieldPolicy policy_{Yielding({false, 0, "ugv5"}, rover(), default_options()), kTolerance_m};
  PlanningScene scene_{static_map_of(free_grid({-5.0, -5.0}, {12.0, 5.0})), {}};
  const std::vector<Vector2> along_x_ = {{9.0, 0.0}, {-4.0, 0.0}};
};

TEST_F(YieldPolicyTest, LooksEveryQuarterOfASecond) {
  EXPECT_TRUE(policy_.due(kNow_s));
  EXPECT_FALSE(policy_.due(kNow_s + 0.2));
  EXPECT_TRUE(policy_.due(kNow_s + 0.3));
}

TEST_F(YieldPolicyTest, GoesOnWhereItIsInNoWay) {
  EXPECT_FALSE(advise(stays({0.0, 0.0})));
  hear("ugv2", along_x_);
  EXPECT_FALSE(advise(stays({0.0, 3.0})));
}

TEST_F(YieldPolicyTest, PullsOverWhereItStandsOrDrivesInTheWayOfAHigherRank) {
  hear("ugv2", along_x_);
  const auto standing_there = advise(stays({0.0, 0.0}));
  ASSERT_TRUE(standing_there);
  EXPECT_EQ(standing_there->event, E::kPullOver);
  EXPECT_EQ(standing_there->pull_over->whose.agent, "ugv2");
  EXPECT_GT(std::abs(standing_there->pull_over->position.y()), 0.8);
  const Motion into_it = straight_drive(kNow_s, {0.0, 3.0}, -M_PI / 2.0, 6.0, 0.5, 0.5);
  RobotIntent drives = stays({0.0, 3.0});
  drives.motion = &into_it;
  const auto driving_there = advise(drives);
  ASSERT_TRUE(driving_there);
  EXPECT_EQ(driving_there->event, E::kPullOverHere);  // it has only to stop
}

TEST_F(YieldPolicyTest, LeavesItsPullOverPointOnlyWhereThatIsInAWay) {
  hear("ugv2", along_x_);
  const PullOverPoint point = *advise(stays({0.0, 0.0}))->pull_over;
  RobotIntent intent = stays({0.0, 0.0});  // still on its way there
  intent.pull_over = point;
  EXPECT_FALSE(advise(intent));
  const Vector2 across(0.0, point.position.y());
  hear("ugv3", {across - Vector2(6.0, 0.0), across + Vector2(6.0, 0.0)});
  const auto next = advise(intent);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->event, E::kPullOver);
  EXPECT_GT((next->pull_over->position - point.position).norm(), kTolerance_m);
}

TEST_F(YieldPolicyTest, TheWayIsClearWhenItIsAskedForNoMore) {
  hear("ugv2", along_x_);
  RobotIntent intent = stays({0.0, 2.0});
  intent.pull_over = PullOverPoint{{0.0, 2.0}, {false, 0, "ugv2"}};
  EXPECT_FALSE(advise(intent));
  hear("ugv2", {});
  ASSERT_TRUE(advise(intent));
  EXPECT_EQ(advise(intent)->event, E::kWayIsClear);
}

TEST_F(YieldPolicyTest, SaysWhereThereIsNoPlaceAndThenYieldsNoMore) {
  scene_.static_map = static_map_of(free_grid({-0.6, -0.6}, {12.0, 0.6}));  // the way out is ahead
  stand("ugv2", {1.0, 0.0});
  hear("ugv2", {{9.0, 0.0}, {-0.3, 0.0}});
  ASSERT_TRUE(advise(stays({0.0, 0.0})));
  EXPECT_EQ(advise(stays({0.0, 0.0}))->event, E::kNowhereToPullOver);
  policy_.set_stuck(true);
  EXPECT_FALSE(advise(stays({0.0, 0.0})));
  policy_.begin_goal(false);
  EXPECT_TRUE(advise(stays({0.0, 0.0})));
}

TEST_F(YieldPolicyTest, MakesRoomForAllWhileParked) {
  hear("ugv9", along_x_);
  EXPECT_FALSE(advise(stays({0.0, 0.0})));
  policy_.begin_goal(true);
  EXPECT_TRUE(advise(stays({0.0, 0.0})));
}

TEST_F(YieldPolicyTest, AsksForTheWayThatItDrivesElseForThatOnTheMapAndWithdraws) {
  stand("ugv7", {1.0, 0.0});
  const SceneSource scene = [this](const auto&) { return scene_; };
  RobotIntent intent = stays({0.0, 0.0});
  EXPECT_FALSE(policy_.ask(intent, {6.0, 0.0}, scene, kNow_s));
  const auto request = policy_.ask(intent, {6.0, 0.0}, scene, kNow_s + 2.0);
  ASSERT_TRUE(request);
  EXPECT_NEAR(request->path.back().x(), 6.0, 1e-9);
  const Motion shorter = straight_drive(kNow_s + 3.0, {0.0, 0.0}, 0.0, 5.8, 0.5, 0.5);
  intent.motion = &shorter;
  intent.pull_over = PullOverPoint{{6.0, 0.0}, {false, 0, "ugv2"}};
  const auto next = policy_.ask(intent, {6.0, 0.0}, scene, kNow_s + 3.0);
  ASSERT_TRUE(next);
  EXPECT_NEAR(next->path.back().x(), 5.8, 1e-6);
  EXPECT_FALSE(policy_.withdrawal());
  policy_.begin_path();
  ASSERT_TRUE(policy_.withdrawal());
  EXPECT_FALSE(policy_.withdrawal());
}

TEST_F(YieldPolicyTest, AsksInTheNameOfTheHighestWhoseWayItIsInNow) {
  stand("ugv2", {1.0, 0.0});
  const SceneSource scene = [this](const auto&) { return scene_; };
  RobotIntent intent = stays({0.0, 0.0});
  intent.pull_over = PullOverPoint{{6.0, 0.0}, {false, 0, "ugv2"}};
  policy_.ask(intent, {6.0, 0.0}, scene, kNow_s);
  const auto asks = [&](double now_s) {
    return policy_.ask(intent, {6.0, 0.0}, scene, now_s).value().rank.agent;
  };
  hear("ugv2", along_x_, kNow_s + 2.0);
  EXPECT_EQ(asks(kNow_s + 2.0), "ugv2");
  // It needs the way no more, and stands in that of another.
  hear("ugv2", {}, kNow_s + 3.0);
  hear("ugv1", along_x_, kNow_s + 3.0);
  EXPECT_EQ(asks(kNow_s + 3.0), "ugv1");
  hear("ugv1", {}, kNow_s + 4.0);
  EXPECT_EQ(asks(kNow_s + 4.0), "ugv5");
}

}  // namespace
}  // namespace mocha
