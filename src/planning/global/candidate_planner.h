#pragma once

#include <functional>

#include "planning/candidates/drive_optimizer.h"
#include "planning/candidates/plan_result.h"
#include "planning/candidates/planning_scene.h"
#include "planning/global/front_end.h"
#include "safety/requirement.h"

namespace mocha {

/// From a seed to a motion that is proved: optimisation and certificate of one candidate.
class CandidatePlanner {
 public:
  CandidatePlanner(const RobotModel& robot, const PlannerOptions& options);

  /// Tries the start maneuvers of the seed in turn, each with rising effort, until a motion is
  /// certified or `should_stop`.
  PlanCandidate plan(const PlanQuery& query, const CandidateSeed& seed, const PlanningScene& scene,
                     const std::function<bool()>& should_stop) const;

  /// What every certified candidate of a seed costs at least: the time that its least length
  /// takes at the robot's limits of speed and acceleration.
  double least_cost(const CandidateSeed& seed) const;

  /// The first violation of a motion on the map from a time on; no violation if it may be driven.
  Violation certify(const Motion& motion, const ObstacleField<2>& obstacles, double from_s) const;

  const FrontEnd& front_end() const { return front_end_; }
  double max_speed() const { return robot_.limits.max_speed; }  ///< [m/s]

 private:
  void drive(const PlanQuery& query, const StartManeuver& start_maneuver,
             const PlanningScene& scene, const std::function<bool()>& should_stop,
             PlanCandidate& candidate) const;
  MotionOrFault assemble(const PlanQuery& query, const StartManeuver& start_maneuver,
                         PlanarPath curve) const;
  /// Takes the motion as that of the candidate, with what it violates first.
  void prove(const PlanQuery& query, MotionOrFault motion, const ObstacleField<2>& obstacles,
             PlanCandidate& candidate) const;

  const RobotModel robot_;
  const PlannerOptions options_;
  const Requirements requirements_;
  const DriveOptimizer optimizer_;
  const FrontEnd front_end_;
};

}  // namespace mocha
