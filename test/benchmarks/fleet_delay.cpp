// Robots that cross each other's paths over networks that delay and lose, under the two-phase
// protocol of this package and the one-phase one of the paper. Prints JSON. Arguments: protocol
// (one_phase or two_phase), delay [s], loss, by how much clocks are off at most [s], how fast they
// drift at most [s/s], asymmetry of the delay (FleetScene), first seed, number of seeds.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "benchmarks/fleet_scene.h"

namespace mocha {
namespace {

constexpr double kTrackingError_m = 0.03;
constexpr double kJitter_s = 0.02;  // of the delay, upward

struct Cell {
  const char* name;  // of the protocol
  double delay_s;
  double loss;
  double clock_offset_s;
  double clock_drift;
  double asymmetry;
};

/// Settling takes a message to each peer and its answer; a lost one is sent again with the next
/// heartbeat.
FleetOptions rules_for(const Cell& cell) {
  const bool one_phase = std::strcmp(cell.name, "one_phase") == 0;
  FleetOptions options;
  options.protocol = one_phase ? Protocol::kOnePhase : Protocol::kTwoPhase;
  options.delta_dc_s = (1.0 + cell.asymmetry) * cell.delay_s + kJitter_s + 0.04;
  options.settle_s = 0.25 + 2.0 * (cell.delay_s + kJitter_s) + 1.5 * cell.loss;
  options.tracking_error_m = kTrackingError_m;
  options.planning_threads = 1;
  return options;
}

/// Each clock is off by as much as may be at most, or less.
std::vector<FleetClock> clocks_of(const Cell& cell, int robots, int seed) {
  std::mt19937 random(seed);
  const auto share = [&] { return 2.0 * static_cast<double>(random()) / random.max() - 1.0; };
  std::vector<FleetClock> clocks(robots);
  for (FleetClock& clock : clocks) {
    clock.ahead_s = share() * cell.clock_offset_s;
    clock.drift = share() * cell.clock_drift;
  }
  return clocks;
}

/// By how much each robot arrives later than alone, without team-mates, on average.
double time_lost_s(const FleetWorld& world, const FleetRun& run) {
  double lost_s = 0.0;
  for (std::size_t i = 0; i < run.agents.size(); ++i) {
    FleetScene alone;
    alone.agents = {world.scene.agents[i]};
    alone.options.planning_threads = 1;
    lost_s += run.agents[i].time_s - run_fleet(alone).agents[0].time_s;
  }
  return lost_s / run.agents.size();
}

void print_row(const Cell& cell, int seed) {
  FleetWorld world = crossing_robots(seed);
  world.scene.options = rules_for(cell);
  world.scene.link = {cell.delay_s, cell.delay_s + kJitter_s, cell.loss};
  world.scene.asymmetry = cell.asymmetry;
  world.scene.clocks = clocks_of(cell, static_cast<int>(world.scene.agents.size()), seed);
  const FleetRun run = run_fleet(world.scene);
  int breaches = 0;
  int leases_lost = 0;
  int proposals_refused = 0;
  for (const FleetAgentRun& agent : run.agents) {
    breaches += agent.planning.breaches;
    leases_lost += agent.planning.leases_lost;
    for (const auto& [why, count] : agent.planning.refusals) proposals_refused += count;
  }
  std::printf("{\"protocol\": \"%s\", \"delay_s\": %g, \"loss\": %g", cell.name, cell.delay_s,
              cell.loss);
  std::printf(", \"clock_offset_s\": %g, \"clock_drift\": %g, \"asymmetry\": %g, \"seed\": %d",
              cell.clock_offset_s, cell.clock_drift, cell.asymmetry, seed);
  std::printf(", \"contacts\": %d, \"min_separation_m\": %.4g, \"all_reached\": %s", run.contacts,
              run.min_separation_m, run.all_reached() ? "true" : "false");
  std::printf(", \"robots\": %zu, \"time_s\": %.4g, \"breaches\": %d, \"leases_lost\": %d",
              run.agents.size(), run.time_s, breaches, leases_lost);
  std::printf(", \"refusals\": %d, \"time_lost_s\": %.4g}", proposals_refused,
              time_lost_s(world, run));
}

void run(char** arguments) {
  const Cell cell{arguments[0],
                  std::atof(arguments[1]),
                  std::atof(arguments[2]),
                  std::atof(arguments[3]),
                  std::atof(arguments[4]),
                  std::atof(arguments[5])};
  const int first = std::atoi(arguments[6]);
  const int count = std::atoi(arguments[7]);
  std::printf("{\"rows\": [");
  for (int seed = first; seed < first + count; ++seed) {
    std::printf("%s\n  ", seed == first ? "" : ",");
    print_row(cell, seed);
    std::fflush(stdout);
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 9) {
    std::fprintf(stderr,
                 "usage: benchmark_fleet_delay PROTOCOL DELAY LOSS CLOCK_OFFSET CLOCK_DRIFT "
                 "ASYMMETRY SEED COUNT\n");
    return 1;
  }
  mocha::run(argv + 1);
}
