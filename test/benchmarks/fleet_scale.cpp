// What planning, talking and remembering cost an agent as the fleet grows, at constant density.
// Prints JSON. Arguments: simulated time [s], reach of messages [m] (inf: all hear all), seed,
// number of agents.

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "benchmarks/fleet_scene.h"
#include "benchmarks/median.h"

namespace mocha {
namespace {

std::size_t memory_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

void print_row(double time_s, double reach_m, int seed, int count) {
  FleetWorld world = spread_robots(count, seed);
  world.scene.longest_s = time_s;
  world.scene.reach_m = reach_m;
  world.scene.options.planning_threads = 1;
  const std::size_t before = memory_bytes();
  std::size_t after = before;
  const FleetRun run = run_fleet(world.scene, [&] { after = memory_bytes(); });
  std::vector<double> plans_s;
  std::vector<double> steps_s;
  double protocol_s = 0.0;
  std::size_t bytes = 0;
  std::size_t largest = 0;
  int reached = 0;
  for (const FleetAgentRun& agent : run.agents) {
    const PlanningRecord& planning = agent.planning;
    plans_s.insert(plans_s.end(), planning.plans_s.begin(), planning.plans_s.end());
    steps_s.insert(steps_s.end(), planning.steps_s.begin(), planning.steps_s.end());
    protocol_s += planning.protocol_s;
    bytes += agent.bytes;
    largest = std::max(largest, agent.largest_datagram);
    reached += agent.reached;
  }
  std::printf("{\"agents\": %d, \"replan_s\": %.4g, \"bytes_per_s\": %.5g", count, median(plans_s),
              bytes / (count * run.time_s));
  std::printf(", \"memory_bytes\": %zu, \"step_s\": %.4g", (after - before) / count,
              median(steps_s));
  std::printf(", \"protocol_share\": %.4g, \"largest_datagram\": %zu, \"contacts\": %d",
              protocol_s / (count * run.time_s), largest, run.contacts);
  std::printf(", \"min_separation_m\": %.4g, \"reached\": %d, \"time_s\": %.4g}\n",
              run.min_separation_m, reached, run.time_s);
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: benchmark_fleet_scale TIME REACH SEED AGENTS\n");
    return 1;
  }
  mocha::print_row(std::atof(argv[1]), std::atof(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]));
}
