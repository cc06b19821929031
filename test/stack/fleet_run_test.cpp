// The fleet in one process, as scripts/bench table3, fleet_delay and fleet_scale run it.
#include "benchmarks/fleet_run.h"

#include <gtest/gtest.h>

#include "benchmarks/fleet_scene.h"

namespace mocha {
namespace {

FleetWorld two_that_cross() {
  FleetWorld world = crossing_robots(3);
  world.scene.options.delta_dc_s = 0.15;
  world.scene.options.settle_s = 0.8;
  world.scene.link = {0.0, 0.1, 0.1};
  return world;
}

TEST(FleetRun, TwoRobotsCrossThroughALossyNetworkWithoutContact) {
  const FleetWorld world = two_that_cross();
  ASSERT_EQ(world.scene.agents.size(), 2u);
  const FleetRun run = run_fleet(world.scene);
  EXPECT_TRUE(run.all_reached());
  EXPECT_EQ(run.contacts, 0);
  EXPECT_GE(run.min_separation_m, 0.8);
  for (const FleetAgentRun& agent : run.agents) {
    EXPECT_GT(agent.bytes, 1000u);
    EXPECT_LE(agent.largest_datagram, kMostDatagramBytes);
    EXPECT_GT(agent.planning.plans_s.size(), 1u);
  }
}

TEST(FleetRun, IsTheSameForTheSameScene) {
  const FleetRun first = run_fleet(two_that_cross().scene);
  const FleetRun again = run_fleet(two_that_cross().scene);
  EXPECT_EQ(first.time_s, again.time_s);
  EXPECT_EQ(first.min_separation_m, again.min_separation_m);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(first.agents[i].bytes, again.agents[i].bytes);
}

TEST(FleetRun, WhoHearsNothingDrivesIntoTheOthersAndThatIsSeen) {
  FleetWorld world = two_that_cross();
  world.scene.link.loss = 1.0;
  world.scene.options.protocol = Protocol::kOnePhase;
  int contacts = 0;
  for (const int seed : {0, 3, 6, 9}) {
    FleetWorld deaf = crossing_robots(seed);
    deaf.scene.link = world.scene.link;
    deaf.scene.options = world.scene.options;
    const FleetRun run = run_fleet(deaf.scene);
    contacts += run.contacts;
    EXPECT_TRUE(run.all_reached());
  }
  EXPECT_GT(contacts, 0);
}

/// Where the way is as wide as one robot, one gets through only if another makes room.
class NarrowPlaces : public ::testing::TestWithParam<const char*> {};

TEST_P(NarrowPlaces, AllArriveWithoutContact) {
  FleetScene scene = fleet_of(load_world(GetParam(), "config"), 1);
  scene.options.planning_threads = 1;
  scene.link = {0.0, 0.05, 0.1};
  scene.longest_s = 150.0;
  const FleetRun run = run_fleet(scene);
  EXPECT_TRUE(run.all_reached());
  EXPECT_EQ(run.contacts, 0);
  EXPECT_GE(run.min_separation_m, 0.8);
}

INSTANTIATE_TEST_SUITE_P(Worlds, NarrowPlaces,
                         ::testing::Values("config/worlds/narrow_corridor.yaml",
                                           "config/worlds/passing_place.yaml",
                                           "test/worlds/dead_end_for_two.yaml",
                                           "test/worlds/two_behind_each_other.yaml"));

}  // namespace
}  // namespace mocha
