// What planning, talking and remembering cost a robot as the fleet grows, at constant density.
// Prints JSON. Arguments: simulated time [s], reach of messages [m] (inf: all hear all), seed,
// robots of a fleet, number of such fleets. These know nothing of each other: many robots in one
// process find little of what they need in its caches, which must not be taken for what it costs
// them to be a large fleet.

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <limits>
#include <vector>

#include "benchmarks/fleet_run.h"
#include "benchmarks/fleet_scene.h"
#include "benchmarks/median.h"

namespace mocha {
namespace {

std::size_t memory_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// One after the other in each step.
void run_all(std::deque<FleetSimulation>& fleets) {
  for (bool any = true; any;) {
    any = false;
    for (FleetSimulation& fleet : fleets) {
      if (fleet.is_over()) continue;
      fleet.step();
      any = true;
    }
  }
}

struct Totals {
  int robots = 0;
  int reached = 0;
  int contacts = 0;
  double robot_s = 0.0;  ///< simulated, of all robots
  double protocol_s = 0.0;
  double news_s = 0.0;
  double min_separation_m = std::numeric_limits<double>::infinity();
  std::size_t bytes = 0;
  std::size_t largest_datagram = 0;
  std::vector<double> plans_s;
  std::vector<double> steps_s;

  void add(const FleetRun& run) {
    contacts += run.contacts;
    min_separation_m = std::min(min_separation_m, run.min_separation_m);
    for (const FleetAgentRun& agent : run.agents) {
      const PlanningRecord& planning = agent.planning;
      ++robots;
      reached += agent.reached;
      robot_s += run.time_s;
      protocol_s += planning.protocol_s;
      news_s += planning.news_s;
      bytes += agent.bytes;
      largest_datagram = std::max(largest_datagram, agent.largest_datagram);
      plans_s.insert(plans_s.end(), planning.plans_s.begin(), planning.plans_s.end());
      steps_s.insert(steps_s.end(), planning.steps_s.begin(), planning.steps_s.end());
    }
  }
};

void print_row(double time_s, double reach_m, int seed, int count, int number_of_fleets) {
  std::vector<FleetScene> scenes;
  for (int i = 0; i < number_of_fleets; ++i) {
    FleetScene scene = spread_robots(count, seed + i).scene;
    scene.longest_s = time_s;
    scene.reach_m = reach_m;
    scene.options.planning_threads = 1;
    scenes.push_back(std::move(scene));
  }
  const std::size_t before = memory_bytes();
  std::deque<FleetSimulation> fleets(scenes.begin(), scenes.end());
  run_all(fleets);
  const std::size_t held = memory_bytes() - before;
  Totals totals;
  for (const FleetSimulation& fleet : fleets) totals.add(fleet.run());
  std::printf("{\"agents\": %d, \"fleets\": %d, \"replan_s\": %.4g, \"plans\": %zu", count,
              number_of_fleets, median(totals.plans_s), totals.plans_s.size());
  std::printf(", \"bytes_per_s\": %.5g, \"memory_bytes\": %zu, \"step_s\": %.4g",
              totals.bytes / totals.robot_s, held / totals.robots, median(totals.steps_s));
  std::printf(", \"protocol_share\": %.4g, \"news_share\": %.4g, \"largest_datagram\": %zu",
              totals.protocol_s / totals.robot_s, totals.news_s / totals.robot_s,
              totals.largest_datagram);
  std::printf(", \"contacts\": %d", totals.contacts);
  std::printf(", \"min_separation_m\": %.4g, \"reached\": %d, \"time_s\": %.4g}\n",
              totals.min_separation_m, totals.reached, time_s);
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: benchmark_fleet_scale TIME REACH SEED AGENTS FLEETS\n");
    return 1;
  }
  mocha::print_row(std::atof(argv[1]), std::atof(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]),
                   std::atoi(argv[5]));
}
