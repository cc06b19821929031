#include "simulation/world_simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "simulation/mover_path.h"

namespace mocha {
namespace {

constexpr double kStart_s = 1.0;
constexpr double kStep_s = 0.02;

RobotModel model(const Footprint& footprint) {
  RobotModel model{};
  model.limits.max_wheel_speed = 1.4;
  model.max_wheel_acceleration = 2.5;
  model.limits.track_m = 0.35;
  model.actuator_lag_s = 0.05;
  model.cmd_timeout_s = 0.3;
  model.footprint = footprint;
  model.lidar.field_of_view_rad = 2.0 * M_PI;
  model.lidar.beams = 90;
  model.lidar.min_range_m = 0.05;
  model.lidar.max_range_m = 20.0;
  model.lidar.rate_hz = 10.0;
  return model;
}

WorldRobot robot(const std::string& name, const Pose& start, const Footprint& footprint) {
  return {name, model(footprint), start, {}};
}

struct Outcome {
  std::vector<ContactEvent> contacts;
  std::vector<WorldSimulator::RobotScan> scans;
};

/// Steps on for a time, every robot under its command (robots beyond the list get none).
Outcome run(WorldSimulator& simulator, double duration_s, const std::vector<Twist>& commands) {
  Outcome outcome;
  const double from = simulator.time_s();
  const int steps = static_cast<int>(std::round(duration_s / kStep_s));
  for (int i = 1; i <= steps; ++i) {
    for (std::size_t r = 0; r < commands.size(); ++r) {
      simulator.command(static_cast<int>(r), commands[r]);
    }
    const auto result = simulator.step_to(from + i * kStep_s);
    outcome.contacts.insert(outcome.contacts.end(), result.contacts.begin(), result.contacts.end());
    outcome.scans.insert(outcome.scans.end(), result.scans.begin(), result.scans.end());
  }
  return outcome;
}

World with_robots(std::vector<WorldRobot> robots) {
  World world;
  world.robots = std::move(robots);
  return world;
}

TEST(WorldSimulator, ADiscTouchesACircleOnce) {
  World world = with_robots({robot("ugv1", {}, Footprint::disc(0.3))});
  world.circles = {{{2.0, 0.0}, 0.5}};
  WorldSimulator simulator(world, kStart_s, 1);
  EXPECT_NEAR(simulator.robots()[0].clearance_m, 1.2, 1e-12);
  EXPECT_TRUE(run(simulator, 1.0, {{1.0, 0.0}}).contacts.empty());
  const Outcome through = run(simulator, 2.0, {{1.0, 0.0}});
  ASSERT_EQ(through.contacts.size(), 1u);
  EXPECT_EQ(through.contacts[0].robot, "ugv1");
  EXPECT_EQ(through.contacts[0].other, "static");
  EXPECT_GT(through.contacts[0].depth_m, 0.0);
  EXPECT_LT(through.contacts[0].depth_m, 0.03);
  EXPECT_NEAR((through.contacts[0].touch.place - Vector2(1.5, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_LT(simulator.robots()[0].clearance_m, 0.0);
  run(simulator, 3.0, {{1.0, 0.0}});  // out on the far side
  EXPECT_GT(simulator.robots()[0].clearance_m, 0.1);
  EXPECT_EQ(simulator.robots()[0].contacts, 1u);
  EXPECT_EQ(run(simulator, 4.0, {{-1.0, 0.0}}).contacts.size(), 1u);  // and back in: a new one
}

TEST(WorldSimulator, ARectangleTouchesWithItsTrueShape) {
  const Footprint jackal = Footprint::rectangle(0.508, 0.430);
  World world = with_robots({robot("ugv1", {}, jackal)});
  // Beside the lane: 1.5 cm off the rectangle's side, but within the discs that cover it.
  world.polygons = {{{{1.0, 0.23}, {2.0, 0.23}, {2.0, 1.0}, {1.0, 1.0}}}};
  WorldSimulator past(world, kStart_s, 1);
  EXPECT_TRUE(run(past, 4.0, {{1.0, 0.0}}).contacts.empty());

  WorldSimulator turned(world, kStart_s, 1);
  run(turned, 1.8, {{1.0, 0.0}});
  run(turned, 0.8, {{0.0, 0.0}});
  EXPECT_NEAR(turned.robots()[0].clearance_m, 0.015, 1e-9);
  const Outcome turn = run(turned, 1.0, {{0.0, 0.5}});  // turning sweeps a corner into it
  ASSERT_EQ(turn.contacts.size(), 1u);
  EXPECT_EQ(turn.contacts[0].other, "static");
}

TEST(WorldSimulator, AMovingObstacleRunsIntoAStandingRobot) {
  World world = with_robots({robot("ugv1", {}, Footprint::disc(0.3))});
  world.moving = {along_path(0.2, 1.0, false, {{3.0, 0.0}, {0.4, 0.0}})};
  WorldSimulator simulator(world, kStart_s, 1);
  EXPECT_NEAR(simulator.robots()[0].clearance_m, 2.5, 1e-12);
  const Outcome met = run(simulator, 5.0, {});
  ASSERT_EQ(met.contacts.size(), 1u);
  EXPECT_EQ(met.contacts[0].other, "moving");
  EXPECT_EQ(met.contacts[0].blame, Blame::kStanding);
  EXPECT_NEAR(met.contacts[0].touch.approach_mps(), 1.0, 1e-9);
  EXPECT_EQ(simulator.robots()[0].contacts, 1u);
  EXPECT_EQ(simulator.robots()[0].own_contacts, 0u);
  EXPECT_NEAR(simulator.robots()[0].clearance_m, -0.1, 1e-9);
  EXPECT_NEAR(simulator.moving_discs()[0].centre.x(), 0.4, 1e-9);
}

TEST(WorldSimulator, WhoComesAndGoesIsOnlyThereInBetween) {
  World world = with_robots({robot("ugv1", {}, Footprint::disc(0.3))});
  world.moving = {{0.2, {{1.0, {0.4, 0.0}}, {2.0, {3.0, 0.0}}}, AfterLast::kLeaves}};
  WorldSimulator simulator(world, kStart_s, 1);
  EXPECT_TRUE(simulator.moving_discs().empty());
  EXPECT_TRUE(std::isinf(simulator.robots()[0].clearance_m));
  EXPECT_TRUE(run(simulator, 0.98, {}).contacts.empty());
  const Outcome appears = run(simulator, 0.04, {});
  ASSERT_EQ(appears.contacts.size(), 1u);
  EXPECT_EQ(appears.contacts[0].blame, Blame::kStanding);
  EXPECT_EQ(simulator.moving_discs().size(), 1u);
  run(simulator, 1.5, {});
  EXPECT_TRUE(simulator.moving_discs().empty());
  EXPECT_TRUE(std::isinf(simulator.robots()[0].clearance_m));
}

TEST(WorldSimulator, TouchesAgainWhoeverComesBack) {
  World world = with_robots({robot("ugv1", {}, Footprint::disc(0.3))});
  world.moving = {{0.2, {{0.0, {3.0, 0.0}}, {2.6, {0.4, 0.0}}}, AfterLast::kRepeats}};
  WorldSimulator simulator(world, kStart_s, 1);
  EXPECT_EQ(run(simulator, 8.0, {}).contacts.size(), 3u);
}

TEST(WorldSimulator, TwoRobotsThatMeetHaveAContactEach) {
  WorldSimulator simulator(
      with_robots({robot("ugv1", {{0.0, 0.0}, 0.0}, Footprint::disc(0.3)),
                   robot("ugv2", {{2.0, 0.0}, M_PI}, Footprint::rectangle(0.6, 0.4))}),
      kStart_s, 1);
  EXPECT_NEAR(simulator.min_separation_m(), 2.0, 1e-12);
  EXPECT_TRUE(std::isinf(simulator.robots()[0].clearance_m));  // robots are no obstacles
  const Outcome met = run(simulator, 2.0, {{1.0, 0.0}, {0.5, 0.0}});
  ASSERT_EQ(met.contacts.size(), 2u);
  EXPECT_EQ(met.contacts[0].robot, "ugv1");
  EXPECT_EQ(met.contacts[0].other, "ugv2");
  EXPECT_EQ(met.contacts[1].robot, "ugv2");
  EXPECT_EQ(met.contacts[1].other, "ugv1");
  for (const ContactEvent& contact : met.contacts) {
    EXPECT_EQ(contact.blame, Blame::kOwn);
    EXPECT_NEAR(contact.touch.approach_mps(), 1.5, 0.01);
  }
  EXPECT_EQ(simulator.robots()[0].contacts, 1u);
  EXPECT_EQ(simulator.robots()[1].contacts, 1u);
}

TEST(WorldSimulator, RecordsTheRun) {
  WorldRobot rover = robot("ugv1", {{1.0, 1.0}, M_PI / 2}, Footprint::disc(0.3));
  rover.goal = Goal{{1.0, 3.0}, {}};
  WorldSimulator simulator(with_robots({rover}), kStart_s, 1);
  const RunRecord& record = simulator.robots()[0].record;
  run(simulator, 0.5, {});
  EXPECT_FALSE(record.moved_at_s().has_value());
  run(simulator, 2.0, {{1.0, 0.0}});
  ASSERT_TRUE(record.moved_at_s().has_value());
  EXPECT_GT(*record.moved_at_s(), kStart_s + 0.5 + 0.25);
  EXPECT_LT(*record.moved_at_s(), kStart_s + 0.5 + 0.5);
  EXPECT_FALSE(record.reached_at_s().has_value());  // still moving
  run(simulator, 1.0, {{0.0, 0.0}});
  const double driven = simulator.robots()[0].vehicle.pose().position.y() - 1.0;
  EXPECT_NEAR(driven, 2.0, 0.15);
  EXPECT_TRUE(record.reached_at_s().has_value());
  EXPECT_NEAR(record.path_length_m(), driven, 1e-9);
  run(simulator, 1.0, {{-1.0, 0.0}});
  EXPECT_GT(record.path_length_m(), driven + 0.5);
  EXPECT_LT(*record.reached_at_s(), simulator.time_s() - 1.0);  // stays as it was
}

TEST(WorldSimulator, AGoalWithAHeadingAndABarnGoal) {
  WorldRobot rover = robot("ugv1", {}, Footprint::disc(0.3));
  rover.goal = Goal{{0.1, 0.0}, M_PI / 2};
  WorldSimulator heading(with_robots({rover}), kStart_s, 1);
  run(heading, 0.5, {});
  EXPECT_FALSE(heading.robots()[0].record.reached_at_s().has_value());
  run(heading, 1.57, {{0.0, 1.0}});
  run(heading, 0.5, {{0.0, 0.0}});
  EXPECT_TRUE(heading.robots()[0].record.reached_at_s().has_value());

  rover.goal = Goal{{3.0, 0.0}, {}};
  World barn = with_robots({rover});
  barn.optimal_time_s = 2.0;
  WorldSimulator near(barn, kStart_s, 1);
  run(near, 4.0, {{1.0, 0.0}});
  const auto reached = near.robots()[0].record.reached_at_s();
  ASSERT_TRUE(reached.has_value());  // at full speed, 1 m before the goal
  EXPECT_NEAR(*reached - kStart_s, 2.0 + 0.2 + 0.05, 0.05);
}

TEST(WorldSimulator, ScansComeAtTheirRateWithTheTimeOfTheirFirstBeam) {
  World world = with_robots({robot("ugv1", {}, Footprint::disc(0.3)),
                             robot("ugv2", {{5.0, 0.0}, 0.0}, Footprint::disc(0.3))});
  world.robots[0].model.lidar.sweep_time_s = 0.1;
  world.robots[1].model.lidar.rate_hz = 40.0;
  WorldSimulator simulator(world, kStart_s, 1);
  int counts[2] = {0, 0};
  for (const auto& [index, scan] : run(simulator, 2.0, {}).scans) {
    const double expected = kStart_s + counts[index] * (index == 0 ? 0.1 : 0.025);
    EXPECT_NEAR(scan.start_time_s, expected, 1e-9);
    if (index == 0) {
      EXPECT_NEAR(scan.ranges_m[45], 4.7f, 1e-4);  // the other robot
    }
    ++counts[index];
  }
  EXPECT_EQ(counts[0], 20);
  EXPECT_EQ(counts[1], 81);
}

TEST(WorldSimulator, TheSameSeedGivesTheSameNumbers) {
  const World world = load_world("config/worlds/corridor.yaml", "config");
  WorldSimulator first(world, kStart_s, 7);
  WorldSimulator second(world, kStart_s, 7);
  WorldSimulator other(world, kStart_s, 8);
  const std::vector<Twist> commands = {{0.5, 0.3}, {0.5, -0.3}};
  const Outcome a = run(first, 2.0, commands);
  const Outcome b = run(second, 2.0, commands);
  const Outcome c = run(other, 2.0, commands);
  ASSERT_EQ(a.scans.size(), b.scans.size());
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_EQ(a.scans[i].scan.ranges_m, b.scans[i].scan.ranges_m);
  }
  EXPECT_NE(a.scans[0].scan.ranges_m, c.scans[0].scan.ranges_m);
  EXPECT_NE(a.scans[0].scan.ranges_m, a.scans[1].scan.ranges_m);
  EXPECT_EQ(first.robots()[1].odometry.pose().position,
            second.robots()[1].odometry.pose().position);
  EXPECT_NE(first.robots()[1].odometry.pose().position, other.robots()[1].odometry.pose().position);
}

TEST(WorldSimulator, RefusesToStepBackAndCommandsThatAreNotFinite) {
  WorldSimulator simulator(with_robots({robot("ugv1", {}, Footprint::disc(0.3))}), kStart_s, 1);
  EXPECT_THROW(simulator.step_to(kStart_s), std::invalid_argument);
  EXPECT_THROW(simulator.command(0, {NAN, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
