#pragma once

#include <optional>

#include "benchmarks/replan_scene.h"

namespace mocha {

/// What a solution must keep to.
struct SolverOptions {
  double to_walls_m = 0.1;   ///< footprint to static obstacle
  double to_movers_m = 0.2;  ///< footprint to the true disc of a mover
  double max_speed = 1.0;
  double max_acceleration = 0.8;  ///< of the vector, along and across together
  double max_yaw_rate = 1.5;      ///< of the direction of travel
  double longest_s = 35.0;        ///< to standing at the goal
  double goal_tolerance_m = 0.15;
};

/// When a robot can stand at the goal of the scene, by a search in space and time that has nothing
/// in common with the planner and knows what the movers will really do; nothing if it finds no way
/// in time.
///
/// A*, on a lattice of a double integrator: half a second at a time at -0.5, 0 or 0.5 m/s^2 along
/// each axis, every way checked each 0.05 s. Of states within 0.25 m at the same velocity and time
/// one is followed up, all of them near the goal. The first half second goes on as it began, as no
/// motion is driven before it is promised, and a robot that stands has to turn before it drives
/// off. A way that is found is a proof; that none is found is strong evidence.
std::optional<double> arrival_time_s(const ReplanScene& scene, const SolverOptions& options);

}  // namespace mocha
