#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/fleet_options.h"
#include "benchmarks/soak_faults.h"
#include "simulation/world_simulator.h"
#include "world/world_file.h"

namespace mocha {

/// Robots that patrol a world of which they know all that stands, in one process and in simulated
/// time. The start and the goal of each robot are the places of one patrol.
struct SoakScene {
  World world;
  FleetOptions options;
  SoakFaults faults;
  double duration_s = 300.0;
  double swap_every_s = 75.0;  ///< the robots swap patrols
  double stay_s = 2.0;         ///< at each place
  std::uint64_t seed = 1;      ///< of the network, and of when robots look
};

/// A robot with a goal did not get anywhere for longer than SoakRun::kStuck_s, or still does not.
struct SoakWait {
  int robot;
  double begin_s;
  double lasts_s;
  Vector2 place;
  Vector2 goal;
  std::string words;  ///< of its nodes, once it had waited for that long
};

struct SoakContact {
  double time_s;
  ContactEvent event;
};

/// What a minute came to.
struct SoakMinute {
  std::size_t memory_bytes;  ///< in use by the whole process
  int arrivals;
  double longest_wait_s;  ///< that was under way
};

struct SoakRun {
  static constexpr double kStuck_s = 60.0;

  double time_s = 0.0;  ///< so far
  int arrivals = 0;
  int gave_up = 0;                       ///< goals, which they then were given again
  double longest_wait_s = 0.0;           ///< see ProgressWatch
  double longest_without_arrival_s = 0;  ///< of a robot
  std::vector<SoakWait> stuck;
  std::vector<SoakContact> contacts;
  double min_separation_m = std::numeric_limits<double>::infinity();
  int node_restarts = 0;
  int robot_restarts = 0;
  int blackouts = 0;
  RobotNodes::Counts promises;  ///< of all robots
  std::vector<SoakMinute> minutes;
};

/// The same for the same scene, but for the memory. `after_minute` is called with what the run came
/// to so far.
SoakRun run_soak(const SoakScene& scene, const std::function<void(const SoakRun&)>& after_minute);

}  // namespace mocha
