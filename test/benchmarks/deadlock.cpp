// Robots that want to go through the same narrow places in opposite directions, in one process.
// Prints JSON. Arguments: a world file, first seed, number of seeds; or --trace, a world file and a
// seed for the places of every robot.

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "benchmarks/curve_json.h"
#include "benchmarks/fleet_scene.h"

namespace mocha {
namespace {

constexpr double kLongest_s = 240.0;

FleetScene scene_of(const char* path, int seed) {
  FleetScene scene = fleet_of(load_world(path, "config"), seed);
  scene.rules.planning_threads = 1;
  scene.link = {0.0, 0.03, 0.05};
  scene.longest_s = kLongest_s;
  return scene;
}

const char* text(bool value) { return value ? "true" : "false"; }

void print_rows(const char* path, int first, int count) {
  std::printf("{\"rows\": [");
  for (int seed = first; seed < first + count; ++seed) {
    const FleetRun run = run_fleet(scene_of(path, seed));
    int reached = 0;
    for (const FleetAgentRun& agent : run.agents) reached += agent.reached;
    std::printf("%s\n  {\"seed\": %d, \"robots\": %zu, \"reached\": %d", seed > first ? "," : "",
                seed, run.agents.size(), reached);
    std::printf(", \"contacts\": %d, \"min_separation_m\": %.4g, \"all_reached\": %s", run.contacts,
                run.min_separation_m, text(run.all_reached()));
    std::printf(", \"time_s\": %.4g}", run.time_s);
    std::fflush(stdout);
  }
  std::printf("]}\n");
}

void print_trace(const char* path, int seed) {
  const FleetScene scene = scene_of(path, seed);
  const FleetRun run = run_fleet(scene);
  std::printf("{\"seed\": %d, \"sample_s\": %g, \"agents\": [", seed, FleetRun::kSample_s);
  for (std::size_t i = 0; i < run.agents.size(); ++i) {
    const Vector2& goal = scene.agents[i].goal;
    std::printf("%s{\"goal\": [%g, %g], \"reached\": %s", i == 0 ? "" : ",\n", goal.x(), goal.y(),
                text(run.agents[i].reached));
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
  if (argc == 4 && std::strcmp(argv[1], "--trace") == 0) {
    mocha::print_trace(argv[2], std::atoi(argv[3]));
  } else if (argc == 4) {
    mocha::print_rows(argv[1], std::atoi(argv[2]), std::atoi(argv[3]));
  } else {
    return 2;
  }
}
