#pragma once

#include <optional>
#include <vector>

#include "benchmarks/space_time_solver.h"
#include "world/world_file.h"

namespace mocha {

/// What the world's first robot has to solve from `begin_s` on, if it knows where the movers will
/// be. Its body is the disc that it sweeps when it turns in place.
SpaceTimeProblem problem_of(const World& world, double begin_s);

/// As that robot drives, up to `limit_s` in the time of the movers.
SolverOptions solver_options(const World& world, double begin_s, double limit_s);

/// How a drive on sight is careful.
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
};

/// Drives the world's first robot by the solver's searches on what its lidar has seen so far; see
/// MoverSightings for what that is. Movers are expected to keep their true velocities, and searches
/// keep from them by more the farther ahead. Where no such way goes on for 5 s, searches keep less,
/// then use the emergency acceleration, then also stand where they will be touched; where none of
/// these is found, the robot brakes as hard as it can. A drive ends at the goal, or with a contact
/// of the robot's own by the simulator's rule: with its true footprint, turned as it drives. Turns
/// in place take their time, but are not seen from and touch nothing.
///
/// One that arrives proves that what the lidar sees is enough; that none does proves nothing.
SightedDrive drive_on_sight(const World& world, double begin_s, double limit_s,
                            const SightOptions& sight);

}  // namespace mocha
