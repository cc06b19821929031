// Orders that lead by obstacles which only the robot that is sent there knows of.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "planning/executive/passing_fleet.h"

namespace mocha {
namespace {

/// A corridor for one along x, with a siding above and one below it, one of which may be full.
enum class Full { kNone, kAbove, kBelow };
std::shared_ptr<const StaticMap> two_sidings(Full full) {
  OccupancyGrid grid = free_grid({-5.2, -2.2}, {5.2, 2.2});
  for (const double side : {-1.0, 1.0}) {
    const auto fill = [&](double x0, double x1, double y0, double y1) {
      fill_box(grid, {x0, std::min(side * y0, side * y1)}, {x1, std::max(side * y0, side * y1)});
    };
    fill(-5.2, -1.0, 0.6, 2.2);
    fill(1.0, 5.2, 0.6, 2.2);
    fill(-1.0, 1.0, 2.0, 2.2);
  }
  fill_box(grid, {-5.2, -0.6}, {-5.0, 0.6});
  fill_box(grid, {5.0, -0.6}, {5.2, 0.6});
  if (full == Full::kAbove) fill_box(grid, {-1.0, 0.7}, {1.0, 2.0});
  if (full == Full::kBelow) fill_box(grid, {-1.0, -2.0}, {1.0, -0.7});
  return static_map_of(grid);
}

class PassingObstaclesTest : public PassingFleet {
 protected:
  /// The obstacles that it has told of last.
  static std::vector<Vector2> told_of(const Robot& robot) {
    const auto intents = said<PassingIntent>(robot);
    return intents.empty() ? std::vector<Vector2>() : intents.back().obstacles;
  }
};

TEST_F(PassingObstaclesTest, TheNextOrderLeadsRoundThem) {
  static_map_ = two_sidings(Full::kNone);
  int told = 0;
  for (const Full full : {Full::kAbove, Full::kBelow}) {
    robots_.clear();
    // The first makes the orders, the second is nearer to the sidings.
    add("ugv1", {-3.0, 0.0}, Vector2(4.0, 0.0));
    Robot& second = add("ugv2", {1.4, 0.0}, Vector2(-4.0, 0.0));
    second.own_map = two_sidings(full);
    bool tells = false;
    for (int i = 0; i < 400; ++i) {
      step();
      tells = tells || !told_of(second).empty();
      ASSERT_LT(full == Full::kAbove ? second.place(now_s_).y() : -second.place(now_s_).y(), 0.4);
    }
    for (const Robot& robot : robots_) EXPECT_TRUE(robot.is_there(now_s_)) << robot.name;
    told += tells;
  }
  EXPECT_EQ(told, 1) << "one of the sidings is taken first";
}

TEST_F(PassingObstaclesTest, SuchAnOrderIsNotTakenUpAndTheyAreTold) {
  static_map_ = two_sidings(Full::kNone);
  Robot& robot = add("ugv2", {0.0, 0.0}, Vector2(-4.0, 0.0));
  add("ugv1", {3.0, 0.0}).takes_part = false;
  robot.own_map = two_sidings(Full::kAbove);
  robot.policy->hear(order({{0.0, 0.0}, {0.0, 1.2}}), now_s_);
  run(kStep_s);
  EXPECT_FALSE(robot.policy->follows());
  ASSERT_FALSE(robot.said.empty());
  EXPECT_TRUE(said<PassingIntent>(robot).back().calls);
  ASSERT_FALSE(told_of(robot).empty());
  EXPECT_NEAR((told_of(robot).front() - Vector2(0.0, 0.7)).norm(), 0.0, 0.1);
  robot.policy->hear(order({{0.0, 0.0}, {0.0, -1.2}}, 0, 2), now_s_);
  run(kStep_s);
  EXPECT_TRUE(robot.policy->follows());
  EXPECT_TRUE(told_of(robot).empty()) << "they are not on the way of this order";
}

TEST_F(PassingObstaclesTest, WhoStandsBeforeOneThatCameUpLeavesTheOrderSoon) {
  static_map_ = two_sidings(Full::kNone);
  Robot& robot = add("ugv2", {0.0, 0.0}, Vector2(-4.0, 0.0));
  robot.drives = false;
  robot.policy->hear(order({{0.0, 0.0}, {0.0, 1.2}}), now_s_);
  run(kStep_s);
  ASSERT_TRUE(robot.policy->follows());
  robot.own_map = two_sidings(Full::kAbove);
  run(0.8);
  EXPECT_TRUE(robot.policy->follows()) << "it may be about to drive on";
  run(0.5);
  EXPECT_FALSE(robot.policy->follows());
  EXPECT_FALSE(told_of(robot).empty());
}

TEST_F(PassingObstaclesTest, NoMoreAreToldThanAMessageHolds) {
  static_map_ = two_sidings(Full::kNone);
  Robot& robot = add("ugv2", {-4.0, 0.0});
  OccupancyGrid grid = free_grid({-5.2, -2.2}, {5.2, 2.2});
  fill_box(grid, {-3.0, -2.0}, {5.0, 2.0});
  robot.own_map = static_map_of(grid);
  add("ugv1", {5.0, 0.0}).takes_part = false;
  robot.policy->hear(intent_of("ugv1", true), now_s_);
  robot.policy->hear(order({{-4.0, 0.0}, {4.0, 0.0}}), now_s_);
  run(kStep_s);
  EXPECT_EQ(told_of(robot).size(), kMostObstacles);
}

TEST_F(PassingObstaclesTest, AnotherGoalMakesThemForgotten) {
  static_map_ = two_sidings(Full::kNone);
  Robot& robot = add("ugv2", {0.0, 0.0}, Vector2(-4.0, 0.0));
  robot.own_map = two_sidings(Full::kAbove);
  robot.policy->hear(order({{0.0, 0.0}, {0.0, 1.2}}), now_s_);
  run(kStep_s);
  ASSERT_FALSE(told_of(robot).empty());
  robot.policy->begin_goal();
  robot.policy->hear(intent_of("ugv1", true), now_s_);
  run(0.5);
  ASSERT_FALSE(robot.said.empty());
  EXPECT_TRUE(told_of(robot).empty());
}

}  // namespace
}  // namespace mocha
