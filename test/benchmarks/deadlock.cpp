// Robots that want to go through the same narrow places in opposite directions, in one process.
// Prints JSON. Arguments: a world file, first seed, number of seeds.

#include <cstdio>
#include <cstdlib>

#include "benchmarks/fleet_scene.h"
#include "safety/requirement.h"

namespace mocha {
namespace {

constexpr double kLongest_s = 240.0;

FleetScene scene_of(const char* path, int seed) {
  FleetScene scene = fleet_of(load_world(path, "config"), seed);
  scene.options.planning_threads = 1;
  scene.link = {0.0, 0.03, 0.05};
  scene.longest_s = kLongest_s;
  return scene;
}

const char* text(bool value) { return value ? "true" : "false"; }

/// What each robot can do at best among others.
void print_pace() {
  const RobotModel robot = load_robot_model("config", "rover");
  const double apart_m = robot.footprint.circumscribed_radius_m() + distance_to_peers_m(robot);
  std::printf("{\"pace\": {\"speed_mps\": %.4g, \"acceleration_mps2\": %.4g, \"apart_m\": %.4g},\n",
              robot.limits.max_speed, robot.limits.max_acceleration, apart_m);
}

void print_rows(const char* path, int first, int count) {
  print_pace();
  std::printf(" \"rows\": [");
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

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  mocha::print_rows(argv[1], std::atoi(argv[2]), std::atoi(argv[3]));
}
