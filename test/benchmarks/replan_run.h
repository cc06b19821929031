#pragma once

#include <limits>
#include <vector>

#include "benchmarks/replan_scene.h"
#include "trajectory/motion.h"

namespace mocha {

/// The robot of a scene at a time.
struct RunSample {
  double t;  ///< [s] since the scene began
  Pose pose;
  double speed;
  double to_walls_m;   ///< footprint to the nearest static obstacle
  double to_movers_m;  ///< footprint to the nearest true disc
};

/// A step in which the replanner planned locally; without paths where nothing came of it.
struct Replan {
  double t;
  double t_plan_s;                          ///< wall time of the step
  bool taken;                               ///< a way was found, proved and proposed
  Vector2 rejoin_point;                     ///< of the way taken
  double rejoins_s;                         ///< absolute time at which that is at the rejoin point
  Motion motion;                            ///< absolute times; empty unless taken
  bool other_class;                         ///< than what was followed before
  std::vector<std::vector<Vector2>> paths;  ///< of the front end
};

/// How a scene went in closed loop.
struct ReplanRun {
  bool reached = false;
  bool contact = false;  ///< ends the run
  double time_s = 0.0;   ///< until the end
  double min_clearance_m = std::numeric_limits<double>::infinity();
  int switches = 0;  ///< of the class, soon after the last local plan
  std::vector<Replan> replans;
  double front_end_s = 0.0;     ///< of all threads, in all of these
  double optimisation_s = 0.0;  ///< the same, proofs included
  std::vector<RunSample> samples;
};

/// The planners of a rover against a scene, ten steps a second, with a perfect tracker. In each
/// step they get the movers' true places and velocities with the covariance of a tracker.
ReplanRun run_closed_loop(const ReplanScene& scene, double longest_s);

/// Whether the robot would have touched a mover on a run that heeds none.
bool would_meet(const ReplanRun& undisturbed, const ReplanScene& scene);

}  // namespace mocha
