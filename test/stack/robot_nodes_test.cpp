// Robots whose nodes end and start anew, as scripts/bench soak has them.
#include "benchmarks/robot_nodes.h"

#include <gtest/gtest.h>

#include "benchmarks/stray_sight.h"
#include "simulation/vehicle.h"

namespace mocha {
namespace {

constexpr double kBegin_s = 1.7e9;
constexpr double kTick_s = 0.02;

OccupancyGrid empty_hall() {
  OccupancyGrid grid;
  grid.resolution_m = 0.05;
  grid.origin = {-5.0, -5.0};
  grid.width = 400;
  grid.height = 200;
  grid.cells.assign(400 * 200, OccupancyGrid::kFree);
  return grid;
}

FleetOptions one_thread() {
  FleetOptions options;
  options.planning_threads = 1;
  return options;
}

/// Two robots, the second of which only stands by, and a network without faults.
class RobotNodesTest : public ::testing::Test {
 protected:
  RobotNodesTest() {
    for (const RobotNode node : kRobotNodes) {
      driver_.start(node, now_s());
      watcher_.start(node, now_s());
    }
    sight_.look(now_s(), {state(driving_), state(watching_)});
  }

  double now_s() const { return kBegin_s + kTick_s * ticks_; }
  RobotState state(const Vehicle& vehicle) const {
    return {now_s(), vehicle.pose(), {vehicle.twist().speed, vehicle.twist().yaw_rate}};
  }
  Vector2 place() const { return driving_.pose().position; }
  double speed() const { return driving_.twist().speed; }

  void go_on_for(double time_s) {
    for (const int end = ticks_ + static_cast<int>(time_s / kTick_s); ticks_ < end;) tick();
  }

  void tick() {
    ++ticks_;
    driving_.step(now_s(), kTick_s);
    watching_.step(now_s(), kTick_s);
    if (ticks_ % 5 == 0) sight_.look(now_s(), {state(driving_), state(watching_)});
    work(0, driver_, driving_, watcher_);
    work(1, watcher_, watching_, driver_);
    reached_ = reached_ || driver_.ending() == GoalExecutive::Ending::kReached;
  }

  void work(int index, RobotNodes& robot, Vehicle& vehicle, RobotNodes& other) {
    deliver(robot.settle(now_s()), other);
    RobotSenses senses = sight_.senses(index, now_s(), robot);
    senses.measured = state(vehicle);
    if (ticks_ % 3 == 0) deliver(robot.pursue(now_s(), senses), other);
    if (ticks_ % 5 == 0 || robot.replanning_is_due()) deliver(robot.replan(now_s(), senses), other);
    if (const auto command = robot.drive(now_s(), senses.measured))
      vehicle.command(now_s(), {command->speed, command->yaw_rate});
  }

  void deliver(const RobotNodes::Datagrams& datagrams, RobotNodes& to) {
    for (const RobotNodes::Bytes& datagram : datagrams) to.hear(datagram, now_s());
  }

  /// The driver is under way to (8, 0).
  void set_off() {
    go_on_for(2.0);  // they listen first
    driver_.go_to({8.0, 0.0}, now_s());
    go_on_for(4.0);
    ASSERT_GT(speed(), 0.5);
  }

  int ticks_ = 0;
  Vehicle driving_{load_robot_model("config", "rover"), Pose{{0.0, 0.0}, 0.0}};
  Vehicle watching_{load_robot_model("config", "rover"), Pose{{2.0, 3.0}, 0.0}};
  RobotNodes driver_{"ugv1", one_thread()};
  RobotNodes watcher_{"ugv2", one_thread()};
  StraySight sight_{empty_hall(), 2, 0.3};
  bool reached_ = false;
};

TEST_F(RobotNodesTest, WithoutGlobalPlannerTheRobotDrivesItsPlanToTheEnd) {
  set_off();
  driver_.end(RobotNode::kGlobalPlanner);
  go_on_for(8.0);
  EXPECT_LT((place() - Vector2(8.0, 0.0)).norm(), 0.1);
  driver_.start(RobotNode::kGlobalPlanner, now_s());
  EXPECT_TRUE(driver_.is_idle());  // its goals ended with it
}

TEST_F(RobotNodesTest, WithoutLocalReplannerItBrakesWhichIsToldAndGoesOnAfterARestart) {
  set_off();
  driver_.end(RobotNode::kLocalReplanner);
  go_on_for(3.0);
  EXPECT_LT(speed(), 0.01);
  EXPECT_EQ(driver_.counts().lease_stops, 1);
  EXPECT_TRUE(watcher_.expects_at(place(), now_s()));
  driver_.start(RobotNode::kLocalReplanner, now_s());
  go_on_for(10.0);
  EXPECT_TRUE(reached_);
}

TEST_F(RobotNodesTest, ANewBroadcasterPromisesFirstOfAllWhatIsDriven) {
  set_off();
  driver_.end(RobotNode::kBroadcaster);
  go_on_for(0.6);
  driver_.start(RobotNode::kBroadcaster, now_s());
  go_on_for(0.1);
  EXPECT_GT(speed(), 0.5);  // it never braked
  EXPECT_TRUE(watcher_.expects_at(place(), now_s()));
  go_on_for(10.0);
  EXPECT_TRUE(reached_);
}

TEST_F(RobotNodesTest, WithoutTrackerItStopsAndIsDrivenOnFromThereByANewOne) {
  set_off();
  driver_.end(RobotNode::kTracker);
  go_on_for(1.5);
  EXPECT_LT(speed(), 0.01);
  EXPECT_TRUE(watcher_.expects_at(place(), now_s()));
  driver_.start(RobotNode::kTracker, now_s());
  go_on_for(10.0);
  EXPECT_TRUE(reached_);
}

TEST_F(RobotNodesTest, WhoStopsInSilenceIsSeenWhereItStands) {
  set_off();
  for (const RobotNode node :
       {RobotNode::kGlobalPlanner, RobotNode::kLocalReplanner, RobotNode::kBroadcaster})
    driver_.end(node);
  go_on_for(3.0);
  EXPECT_LT(speed(), 0.01);
  EXPECT_FALSE(watcher_.expects_at(place(), now_s()));
  EXPECT_EQ(sight_.senses(1, now_s(), watcher_).predictions.things.size(), 1u);
  go_on_for(2.0);
  EXPECT_LE(sight_.senses(1, now_s(), watcher_).map->obstacles->distance_bound(place()), 0.0);
  EXPECT_GT(sight_.senses(0, now_s(), driver_).map->obstacles->distance_bound(place()), 1.0);

  for (const RobotNode node : kRobotNodes) driver_.start(node, now_s());
  go_on_for(0.5);
  EXPECT_TRUE(watcher_.expects_at(place(), now_s()));
  EXPECT_GT(sight_.senses(1, now_s(), watcher_).map->obstacles->distance_bound(place()), 1.0);
  driver_.go_to({8.0, 0.0}, now_s());
  go_on_for(10.0);
  EXPECT_TRUE(reached_);
}

}  // namespace
}  // namespace mocha
