// Robots that cross each other's paths over networks that delay and lose, under the two-phase
// protocol of this package and the one-phase one of the paper. Prints JSON. Arguments: protocol
// (one_phase or two_phase), delay [s], loss, first seed, number of seeds.

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "benchmarks/fleet_scene.h"

namespace mocha {
namespace {

constexpr double kTrackingError_m = 0.03;
constexpr double kJitter_s = 0.02;  // of the delay, upward

/// Settling takes a message to each peer and its answer; a lost one is sent again with the next
/// heartbeat.
FleetOptions rules_for(Protocol protocol, double delay_s, double loss) {
  FleetOptions options;
  options.protocol = protocol;
  options.delta_dc_s = delay_s + kJitter_s + 0.04;
  options.settle_s = 0.25 + 2.0 * (delay_s + kJitter_s) + 1.5 * loss;
  options.tracking_error_m = kTrackingError_m;
  options.planning_threads = 1;
  return options;
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

void print_row(Protocol protocol, const char* name, double delay_s, double loss, int seed) {
  FleetWorld world = crossing_robots(seed);
  world.scene.options = rules_for(protocol, delay_s, loss);
  world.scene.link = {delay_s, delay_s + kJitter_s, loss};
  const FleetRun run = run_fleet(world.scene);
  int breaches = 0;
  int leases_lost = 0;
  int proposals_refused = 0;
  for (const FleetAgentRun& agent : run.agents) {
    breaches += agent.planning.breaches;
    leases_lost += agent.planning.leases_lost;
    for (const auto& [why, count] : agent.planning.refusals) proposals_refused += count;
  }
  std::printf("{\"protocol\": \"%s\", \"delay_s\": %g, \"loss\": %g, \"seed\": %d", name, delay_s,
              loss, seed);
  std::printf(", \"contacts\": %d, \"min_separation_m\": %.4g, \"all_reached\": %s", run.contacts,
              run.min_separation_m, run.all_reached() ? "true" : "false");
  std::printf(", \"robots\": %zu, \"time_s\": %.4g, \"breaches\": %d, \"leases_lost\": %d",
              run.agents.size(), run.time_s, breaches, leases_lost);
  std::printf(", \"refusals\": %d, \"time_lost_s\": %.4g}", proposals_refused,
              time_lost_s(world, run));
}

void run(char** arguments) {
  const bool one_phase = std::strcmp(arguments[0], "one_phase") == 0;
  const Protocol protocol = one_phase ? Protocol::kOnePhase : Protocol::kTwoPhase;
  const int first = std::atoi(arguments[3]);
  const int count = std::atoi(arguments[4]);
  std::printf("{\"rows\": [");
  for (int seed = first; seed < first + count; ++seed) {
    std::printf("%s\n  ", seed == first ? "" : ",");
    print_row(protocol, arguments[0], std::atof(arguments[1]), std::atof(arguments[2]), seed);
    std::fflush(stdout);
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: benchmark_fleet_delay PROTOCOL DELAY LOSS SEED COUNT\n");
    return 1;
  }
  mocha::run(argv + 1);
}
