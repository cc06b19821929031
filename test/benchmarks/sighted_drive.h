#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/space_time_solver.h"
#include "world/world_file.h"

namespace mocha {

/// What the world's first robot has to solve from `begin_s` on, if it knows where the movers will
/// be. Its body is the disc that it sweeps when it turns in place.
SpaceTimeProblem problem_of(const World& world, double begin_s);

/// As that robot drives, up to `limit_s` in the time of the movers.
SolverOptions solver_options(const World& world, double begin_s, double limit_s);

struct SightOptions {
  double growth_mps = 0.2;  ///< by so much more is kept for each second of prediction
  double replan_s = 0.5;    ///< from one search to the next
};

/// A contact of a drive.
struct DriveContact {
  double time_s;
  Vector2 place;
  const char* blame;
  bool was_known;  ///< the mover had been seen
};

/// How a drive on sight went.
struct SightedDrive {
  std::optional<double> arrival_s;  ///< standing at the goal, in the time of the movers
  std::vector<DriveContact> contacts;
  bool has_own_contact = false;  ///< ends the drive
  std::vector<Pose> poses;       ///< of each step
};

/// Drives the world's first robot by the solver's searches, again at each step, on what its lidar
/// has seen so far. Movers are expected to keep their velocities, and searches keep from them by
/// more the farther ahead, by `growth_mps` for each second. Where no such way goes on for
/// 5 s, searches keep less, then use the emergency acceleration, then also stand where they
/// will be touched; where none of these is found, the robot brakes as hard as it can.
SightedDrive drive_on_sight(const World& world, double begin_s, double limit_s,
                            const SightOptions& sight);

}  // namespace mocha
