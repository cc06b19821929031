#include "planning/executive/goal_queue.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

using Event = GoalQueue::Event;

RobotState at(double x, double yaw_rad = 0.0, double speed = 0.0, double yaw_rate = 0.0) {
  RobotState state;
  state.pose = {{x, 0.0}, yaw_rad};
  state.twist = {speed, yaw_rate};
  return state;
}

Goal goal(double x, std::optional<double> yaw_rad = std::nullopt) { return {{x, 0.0}, yaw_rad}; }

struct GoalQueueTest : ::testing::Test {
  GoalQueue queue{GoalOptions{0.15, 0.2, 10.0, 0.4}};
};

TEST_F(GoalQueueTest, EmptyHasNothingToSay) {
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.update(100.0, at(0.0)), Event::kNone);
}

TEST_F(GoalQueueTest, ArrivalIsStandingWithinTheTolerance) {
  queue.set({goal(5.0)}, 0.0);
  EXPECT_EQ(queue.update(1.0, at(4.84)), Event::kNone);                 // too far
  EXPECT_EQ(queue.update(2.0, at(4.90, 0.0, 0.3)), Event::kNone);       // still driving
  EXPECT_EQ(queue.update(2.5, at(4.95, 0.0, -0.3)), Event::kNone);      // backward, too
  EXPECT_EQ(queue.update(2.8, at(5.0, 0.0, 0.0, -0.5)), Event::kNone);  // still turning
  EXPECT_EQ(queue.update(3.0, at(5.1)), Event::kAllReached);
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.update(4.0, at(5.1)), Event::kNone);
}

TEST_F(GoalQueueTest, HeadingCountsWhereOneIsAskedForAndWrapsRound) {
  queue.set({goal(5.0, M_PI)}, 0.0);
  EXPECT_EQ(queue.update(1.0, at(5.0, 2.8)), Event::kNone);
  EXPECT_EQ(queue.update(2.0, at(5.0, -M_PI + 0.1)), Event::kAllReached);
}

TEST_F(GoalQueueTest, APatrolBeginsAnewAtItsEnd) {
  queue.set({goal(1.0), goal(2.0), goal(3.0)}, 0.0, true);
  double t = 1.0;
  for (const int lap : {1, 2, 3}) {
    for (const int number : {1, 2, 3}) {
      EXPECT_EQ(queue.progress().goal, number);
      EXPECT_EQ(queue.progress().goals, 3);
      EXPECT_EQ(queue.progress().lap, lap);
      EXPECT_EQ(queue.asked().position.x(), number);
      EXPECT_EQ(queue.update(t += 1.0, at(number)), Event::kReached);
    }
  }
  EXPECT_EQ(queue.progress().words(), "waypoint 1 of 3, lap 4");
  queue.set({goal(5.0)}, t);
  EXPECT_EQ(queue.progress().words(), "");
  EXPECT_EQ(queue.update(t += 1.0, at(5.0)), Event::kAllReached);
}

TEST_F(GoalQueueTest, ProgressCountsTheGoalsOfAList) {
  EXPECT_EQ(queue.progress().goals, 0);
  queue.set({goal(1.0), goal(2.0)}, 0.0);
  EXPECT_EQ(queue.progress().words(), "waypoint 1 of 2");
  EXPECT_EQ(queue.update(1.0, at(1.0)), Event::kReached);
  EXPECT_EQ(queue.progress().words(), "waypoint 2 of 2");
  EXPECT_EQ(queue.update(2.0, at(2.0)), Event::kAllReached);
  EXPECT_EQ(queue.progress().words(), "");
}

TEST_F(GoalQueueTest, NewRulesCountForTheGoalsThatAreThere) {
  queue.set({goal(5.0)}, 0.0);
  EXPECT_EQ(queue.update(1.0, at(4.5)), Event::kNone);
  queue.set_options({0.6, 0.2, 10.0, 0.4});
  EXPECT_EQ(queue.update(2.0, at(4.5)), Event::kAllReached);
}

TEST_F(GoalQueueTest, APlaceFarFromAnOccupiedGoalIsNoArrival) {
  queue.set({goal(5.0)}, 0.0);
  queue.move_current({3.0, 0.0});
  EXPECT_EQ(queue.update(1.0, at(3.0)), Event::kNone);
  queue.move_current({4.6, 0.0});
  EXPECT_EQ(queue.update(2.0, at(3.0)), Event::kNone);
  EXPECT_EQ(queue.update(3.0, at(4.6)), Event::kAllReached);
}

TEST_F(GoalQueueTest, VisitsGoalsInOrder) {
  queue.set({goal(1.0), goal(2.0), goal(1.0)}, 0.0);
  EXPECT_EQ(queue.update(1.0, at(2.0)), Event::kNone);  // not its turn yet
  EXPECT_EQ(queue.update(2.0, at(1.0)), Event::kReached);
  EXPECT_EQ(queue.left().size(), 2u);
  EXPECT_EQ(queue.current().position.x(), 2.0);
  EXPECT_EQ(queue.update(3.0, at(2.0)), Event::kReached);
  EXPECT_EQ(queue.update(4.0, at(1.0)), Event::kAllReached);
}

TEST_F(GoalQueueTest, TimesOutWithoutProgress) {
  queue.set({goal(5.0)}, 100.0);
  for (double t = 100.0; t <= 110.0; t += 0.5)
    EXPECT_EQ(queue.update(t, at(0.0)), Event::kNone) << t;
  EXPECT_EQ(queue.update(110.1, at(0.0)), Event::kTimedOut);
  EXPECT_TRUE(queue.empty());
}

TEST_F(GoalQueueTest, ComingNearerIsProgress) {
  queue.set({goal(50.0)}, 0.0);
  for (double t = 0.0; t < 100.0; t += 1.0)
    EXPECT_EQ(queue.update(t, at(0.02 * t)), Event::kNone) << t;
}

TEST_F(GoalQueueTest, ADetourIsProgressToo) {
  queue.set({goal(5.0)}, 0.0);
  for (double t = 0.0; t < 100.0; t += 1.0)
    EXPECT_EQ(queue.update(t, at(-0.1 * t)), Event::kNone) << t;
}

TEST_F(GoalQueueTest, TremblingIsNot) {
  queue.set({goal(5.0)}, 0.0);
  Event last = Event::kNone;
  for (double t = 0.0; t < 20.0 && last == Event::kNone; t += 0.1)
    last = queue.update(t, at(0.05 * std::sin(t)));
  EXPECT_EQ(last, Event::kTimedOut);
}

TEST_F(GoalQueueTest, EachGoalHasItsOwnTime) {
  queue.set({goal(1.0), goal(50.0)}, 0.0);
  EXPECT_EQ(queue.update(9.0, at(1.0)), Event::kReached);
  EXPECT_EQ(queue.update(15.0, at(1.0)), Event::kNone);
  queue.set({goal(7.0)}, 18.0);
  EXPECT_EQ(queue.update(27.0, at(1.0)), Event::kNone);
  EXPECT_EQ(queue.current().position.x(), 7.0);
}

}  // namespace
}  // namespace mocha
