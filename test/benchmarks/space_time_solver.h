#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "benchmarks/space_time_lattice.h"
#include "benchmarks/static_clearance.h"

namespace mocha {

/// A disc as a function of time [s]: where it is and how large; nothing while it is not there.
using MovingDisc = std::function<std::optional<Circle>(double time_s)>;

/// A disc-shaped robot that is to stand at a goal.
struct SpaceTimeProblem {
  StaticGround ground;
  std::vector<MovingDisc> movers;
  double robot_radius_m = 0.3;
  Pose start;
  double start_speed = 0.0;   ///< [m/s] ahead
  double reaction_s = 0.0;    ///< it goes on so long as it began
  double start_time_s = 0.0;  ///< in the time of the movers
  Vector2 goal = Vector2::Zero();
};

/// What a solution must keep to.
struct SolverOptions {
  double to_walls_m = 0.1;   ///< footprint to static obstacle
  double to_movers_m = 0.2;  ///< footprint to a mover's disc
  double max_speed = 1.0;
  double max_acceleration = 0.8;  ///< of the vector, along and across together
  double max_yaw_rate = 1.5;      ///< of the direction of travel
  bool can_reverse = true;
  double longest_s = 35.0;  ///< to standing at the goal
  double goal_tolerance_m = 0.15;
  LatticeUnits units;
};

/// How one search differs from another of the same problem.
struct SearchLimits {
  double max_acceleration;  ///< [m/s^2]
  /// A way that got as far as this is long enough, wherever it ends [s] in the time of the movers.
  double horizon_s;
  bool may_be_touched_standing = false;
  int most_expansions = 4000000;
};

/// A search in space and time that has nothing in common with the planners.
///
/// A*, on a lattice of a double integrator, every way checked each 0.05 s. Of states that are near
/// each other at the same velocity and time one is followed up, all of them near the goal. A robot
/// that stands has to turn before it drives off. A way that is found is a proof; that none is found
/// is strong evidence.
class SpaceTimeSolver {
 public:
  /// `problem.movers` are not looked at: each search has its own.
  SpaceTimeSolver(const SpaceTimeProblem& problem, const SolverOptions& options);

  const SpaceTimeLattice& lattice() const { return lattice_; }
  LatticeState start() const { return lattice_.start(start_speed_); }
  bool arrived(const LatticeState& state) const;
  SearchLimits whole_way() const;

  /// The way that gets to the goal first: states a step apart from `from` on; empty if none is
  /// found.
  std::vector<LatticeState> way(const LatticeState& from, const std::vector<MovingDisc>& movers,
                                const SearchLimits& limits) const;

 private:
  friend class SpaceTimeSearch;

  SolverOptions options_;
  SpaceTimeLattice lattice_;
  StaticClearance clearance_;
  double robot_radius_m_;
  double start_speed_;
  double reaction_s_;
  double start_time_s_;
  Vector2 goal_;
};

/// When the robot can stand at the goal, in the time of the movers, if it knows where they will be;
/// nothing if no way is found.
std::optional<double> arrival_time_s(const SpaceTimeProblem& problem, const SolverOptions& options);

}  // namespace mocha
