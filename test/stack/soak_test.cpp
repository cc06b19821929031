// What scripts/bench soak does to a fleet.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "benchmarks/patrols.h"
#include "benchmarks/progress_watch.h"
#include "benchmarks/soak_run.h"

namespace mocha {
namespace {

TEST(Patrols, NoTwoRobotsEverGoToOnePlace) {
  Patrols patrols({{{0.0, 0.0}, {1.0, 0.0}}, {{2.0, 0.0}, {3.0, 0.0}}, {{4.0, 0.0}, {5.0, 0.0}}});
  for (int step = 0; step < 12; ++step) {
    std::set<double> places;
    for (int robot = 0; robot < 3; ++robot) places.insert(patrols.next(robot).x());
    EXPECT_EQ(places.size(), 3u);
    patrols.arrive(step % 3);
    if (step % 2 == 1) patrols.swap();
  }
}

TEST(Patrols, ASwapGivesEachRobotWhereTheNextOneWasGoing) {
  Patrols patrols({{{0.0, 0.0}, {1.0, 0.0}}, {{2.0, 0.0}, {3.0, 0.0}}});
  patrols.arrive(1);
  patrols.swap();
  EXPECT_EQ(patrols.next(0).x(), 2.0);
  EXPECT_EQ(patrols.next(1).x(), 1.0);
  patrols.arrive(0);
  EXPECT_EQ(patrols.next(0).x(), 3.0);
}

TEST(ProgressWatch, WaitsUntilTheRobotHasGotSomewhere) {
  ProgressWatch watch;
  watch.restart(1.0, {0.0, 0.0});
  EXPECT_EQ(watch.update(5.0, {0.2, 0.0}), 4.0);
  EXPECT_EQ(watch.update(6.0, {-0.2, 0.0}), 5.0);  // to and fro is no way to get anywhere
  EXPECT_EQ(watch.update(7.0, {0.4, 0.0}), 0.0);
  EXPECT_EQ(watch.update(9.0, {0.4, 0.0}), 2.0);
}

TEST(SoakFaults, AreTheSameForTheSameSeedHoweverLongTheRunIs) {
  const SoakFaults shorter = SoakFaults::drawn(600.0, 6, 7);
  const SoakFaults longer = SoakFaults::drawn(3600.0, 6, 7);
  ASSERT_LT(shorter.faults.size(), longer.faults.size());
  for (std::size_t i = 0; i < shorter.faults.size(); ++i) {
    EXPECT_EQ(shorter.faults[i].begin_s, longer.faults[i].begin_s);
    EXPECT_EQ(shorter.faults[i].end_s, longer.faults[i].end_s);
    EXPECT_EQ(shorter.faults[i].robot, longer.faults[i].robot);
  }
  for (std::size_t i = 0; i < shorter.links.size(); ++i)
    EXPECT_EQ(shorter.links[i].link.loss, longer.links[i].link.loss);
  EXPECT_NE(SoakFaults::drawn(600.0, 6, 8).faults[0].end_s, shorter.faults[0].end_s);
}

TEST(SoakFaults, OfOneRobotDoNotOverlapAndAreOfAllKinds) {
  std::map<int, double> free_s;
  std::map<SoakFault::Kind, int> counts;
  std::set<RobotNode> nodes;
  for (const SoakFault& fault : SoakFaults::drawn(3600.0, 6, 1).faults) {
    EXPECT_GT(fault.begin_s, free_s[fault.robot]);
    EXPECT_GT(fault.end_s, fault.begin_s);
    free_s[fault.robot] = fault.end_s;
    ++counts[fault.kind];
    if (fault.kind == SoakFault::Kind::kNode) nodes.insert(fault.node);
  }
  EXPECT_GT(counts[SoakFault::Kind::kNode], 100);
  EXPECT_GT(counts[SoakFault::Kind::kRobot], 20);
  EXPECT_GT(counts[SoakFault::Kind::kBlackout], 70);
  EXPECT_EQ(nodes.size(), kRobotNodes.size());
}

SoakScene two_that_swap(double duration_s) {
  SoakScene scene;
  scene.world = load_world("config/worlds/two_swap.yaml", "config");
  scene.options = {Protocol::kTwoPhase, 0.1, 0.6, 0.0, 1};
  scene.faults = SoakFaults::drawn(duration_s, 2, 3);
  scene.duration_s = duration_s;
  scene.swap_every_s = 15.0;
  return scene;
}

TEST(Soak, RobotsArriveAgainAndAgainWithoutContact) {
  const SoakRun run = run_soak(two_that_swap(40.0), [](const SoakRun&) {});
  EXPECT_GE(run.arrivals, 4);
  EXPECT_TRUE(run.contacts.empty());
  EXPECT_TRUE(run.stuck.empty());
  EXPECT_GT(run.node_restarts + run.robot_restarts + run.blackouts, 2);
}

TEST(Soak, IsTheSameForTheSameScene) {
  const SoakRun first = run_soak(two_that_swap(15.0), [](const SoakRun&) {});
  const SoakRun again = run_soak(two_that_swap(15.0), [](const SoakRun&) {});
  EXPECT_EQ(first.min_separation_m, again.min_separation_m);
  EXPECT_EQ(first.longest_wait_s, again.longest_wait_s);
}

}  // namespace
}  // namespace mocha
