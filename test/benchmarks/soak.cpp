// Six robots that patrol an office and swap patrols, while nodes and robots are started anew and
// the network loses, delays and is cut. Prints JSON, and its progress to stderr. Arguments: a world
// file, simulated time [h], seed.

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "benchmarks/soak_run.h"

namespace mocha {
namespace {

constexpr double kHour_s = 3600.0;

SoakScene scene_of(const char* path, double hours, std::uint64_t seed) {
  SoakScene scene;
  scene.world = load_world(path, "config");
  scene.options.planning_threads = 1;
  scene.options.delta_dc_s = 0.1;
  scene.options.settle_s = 0.6;
  scene.duration_s = kHour_s * hours;
  scene.seed = seed;
  const int robots = static_cast<int>(scene.world.robots.size());
  scene.faults = SoakFaults::drawn(scene.duration_s, robots, seed);
  return scene;
}

void print_progress(const SoakRun& run, double wall_s) {
  std::fprintf(stderr,
               "%5.0f min: %4d arrivals, longest wait %5.1f s (now %5.1f s), %zu contacts,"
               " %.2f MB; %.0f s of wall time\n",
               run.time_s / 60.0, run.arrivals, run.longest_wait_s,
               run.minutes.back().longest_wait_s, run.contacts.size(),
               1e-6 * run.minutes.back().memory_bytes, wall_s);
}

void print_stuck(const SoakRun& run) {
  std::printf(",\n \"stuck\": [");
  for (const SoakWait& wait : run.stuck) {
    std::printf("%s\n  {\"robot\": %d, \"begin_s\": %.2f, \"lasts_s\": %.2f",
                &wait == &run.stuck.front() ? "" : ",", wait.robot + 1, wait.begin_s, wait.lasts_s);
    std::printf(", \"place\": [%.2f, %.2f], \"goal\": [%.2f, %.2f], \"words\": \"%s\"}",
                wait.place.x(), wait.place.y(), wait.goal.x(), wait.goal.y(), wait.words.c_str());
  }
  std::printf("]");
}

void print_contacts(const SoakRun& run) {
  std::printf(",\n \"contacts\": [");
  for (const SoakContact& contact : run.contacts) {
    const ContactEvent& event = contact.event;
    std::printf("%s\n  {\"time_s\": %.2f, \"robot\": \"%s\", \"other\": \"%s\"",
                &contact == &run.contacts.front() ? "" : ",", contact.time_s, event.robot.c_str(),
                event.other.c_str());
    std::printf(", \"place\": [%.2f, %.2f], \"approach_mps\": %.3f, \"depth_m\": %.4f}",
                event.touch.place.x(), event.touch.place.y(), event.touch.approach_mps(),
                event.depth_m);
  }
  std::printf("]");
}

void print_minutes(const SoakRun& run) {
  std::printf(",\n \"minutes\": [");
  for (const SoakMinute& minute : run.minutes) {
    std::printf("%s\n  {\"memory_bytes\": %zu, \"arrivals\": %d, \"longest_wait_s\": %.2f}",
                &minute == &run.minutes.front() ? "" : ",", minute.memory_bytes, minute.arrivals,
                minute.longest_wait_s);
  }
  std::printf("]");
}

void print(const SoakRun& run, double wall_s) {
  std::printf("{\"time_s\": %.1f, \"wall_s\": %.1f, \"arrivals\": %d, \"gave_up\": %d", run.time_s,
              wall_s, run.arrivals, run.gave_up);
  std::printf(", \"longest_wait_s\": %.2f, \"longest_without_arrival_s\": %.2f", run.longest_wait_s,
              run.longest_without_arrival_s);
  std::printf(", \"min_separation_m\": %.4f", run.min_separation_m);
  std::printf(",\n \"node_restarts\": %d, \"robot_restarts\": %d, \"blackouts\": %d",
              run.node_restarts, run.robot_restarts, run.blackouts);
  std::printf(", \"breaches\": %d, \"leases_lost\": %d, \"refusals\": %d", run.promises.breaches,
              run.promises.lease_stops, run.promises.refusals);
  print_stuck(run);
  print_contacts(run);
  print_minutes(run);
  std::printf("}\n");
}

void run(const char* path, double hours, std::uint64_t seed) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto wall_s = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const SoakScene scene = scene_of(path, hours, seed);
  const SoakRun run =
      run_soak(scene, [&](const SoakRun& so_far) { print_progress(so_far, wall_s()); });
  print(run, wall_s());
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: benchmark_soak WORLD HOURS SEED\n");
    return 2;
  }
  mocha::run(argv[1], std::atof(argv[2]), std::strtoull(argv[3], nullptr, 10));
}
