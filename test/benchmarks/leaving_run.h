#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "world/world_file.h"

namespace mocha {

/// How a robot left where it stood; times are simulated, from the goal on.
struct LeavingRun {
  bool arrived = false;  ///< stands at its goal in time, and has touched nothing
  bool contact = false;
  std::optional<double> left_s;  ///< it was half a metre away from where it stood
  double took_s = 0.0;           ///< until it arrived, touched something or failed
  double clearance_m = 0.0;      ///< least of its true body
  double slowest_plan_s = 0.0;   ///< wall time
  std::string words;             ///< of the stack, the last that kept it from its goal
};

/// Sends the first robot of a world to its goal, through its whole stack, after 3 s of standing. It
/// has 60 s; one that stands for 10 s has failed.
LeavingRun run_leaving(const World& world, std::uint64_t seed);

}  // namespace mocha
