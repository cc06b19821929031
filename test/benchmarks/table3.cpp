// The paper's Table III: five agents from nearby starts to goals of their own, in one process.
// Prints JSON. Arguments: the seeds of the scenes, or --trace and one of them for all that is to be
// drawn of it.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "benchmarks/curve_json.h"
#include "benchmarks/fleet_scene.h"
#include "benchmarks/median.h"

namespace mocha {
namespace {

const char* text(bool value) { return value ? "true" : "false"; }

void print_row(int seed, int i, const FleetAgent& agent, const FleetAgentRun& run) {
  std::printf("\n  {\"agent\": \"(%g,%g)\", \"t_plan_s\": %.4g, \"paths\": %d, \"d_min_m\": %.4g",
              agent.start.position.x(), agent.start.position.y(), median(run.planning.plans_s),
              run.planning.paths, run.least_separation_m);
  std::printf(", \"reached\": %s, \"seed\": %d, \"number\": %d, \"time_s\": %.4g",
              text(run.reached), seed, i + 1, run.time_s);
  std::printf(", \"plans\": %zu, \"slowest_plan_s\": %.4g, \"leases_lost\": %d}",
              run.planning.plans_s.size(),
              *std::max_element(run.planning.plans_s.begin(), run.planning.plans_s.end()),
              run.planning.leases_lost);
}

void print_rows(int count, char** seeds) {
  std::printf("{\"rows\": [");
  int contacts = 0;
  for (int i = 0; i < count; ++i) {
    const int seed = std::atoi(seeds[i]);
    const FleetWorld world = five_agents(seed);
    const FleetRun run = run_fleet(world.scene);
    contacts += run.contacts;
    for (std::size_t k = 0; k < run.agents.size(); ++k) {
      if (i + k > 0) std::printf(",");
      print_row(seed, static_cast<int>(k), world.scene.agents[k], run.agents[k]);
    }
    std::fflush(stdout);
  }
  std::printf("],\n\"contacts\": %d}\n", contacts);
}

void print_trace(int seed) {
  const FleetWorld world = five_agents(seed);
  const FleetRun run = run_fleet(world.scene);
  std::printf("{\"seed\": %d, \"sample_s\": %g, \"radius_m\": %g", seed, FleetRun::kSample_s,
              load_robot_model("config", "rover").footprint.circumscribed_radius_m());
  Eigen::MatrixXd circles(3, world.circles.size());
  for (int i = 0; i < circles.cols(); ++i)
    circles.col(i) << world.circles[i].centre, world.circles[i].radius_m;
  print_columns("circles", circles);
  std::printf(",\n\"agents\": [");
  for (std::size_t i = 0; i < run.agents.size(); ++i) {
    const FleetAgent& agent = world.scene.agents[i];
    std::printf("%s{\"goal\": [%g, %g], \"reached\": %s", i == 0 ? "" : ",\n", agent.goal.x(),
                agent.goal.y(), text(run.agents[i].reached));
    Eigen::MatrixXd places(2, run.agents[i].places.size());
    for (int k = 0; k < places.cols(); ++k) places.col(k) = run.agents[i].places[k];
    print_columns("places", places);
    std::printf("}");
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--trace") == 0) {
    mocha::print_trace(std::atoi(argv[2]));
  } else {
    mocha::print_rows(argc - 1, argv + 1);
  }
}
