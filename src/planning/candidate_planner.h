#pragma once

#include <functional>

#include "planning/drive_optimizer.h"
#include "planning/front_end.h"
#include "planning/plan_result.h"
#include "planning/planning_scene.h"

namespace mocha {

/// From an approach to a motion that is proved: optimisation and certificate of one candidate.
class CandidatePlanner {
 public:
  CandidatePlanner(const RobotModel& robot, const PlannerRules& rules);

  /// Tries the openings of the approach in turn, each with rising effort, until a motion is
  /// certified or `should_stop`.
  PlanCandidate plan(const PlanQuery& query, const Approach& approach, const PlanningScene& scene,
                     const std::function<bool()>& should_stop) const;

  /// What every certified candidate of an approach costs at least: the time that its least length
  /// takes at the robot's limits of speed and acceleration.
  double least_cost(const Approach& approach) const;

  /// The first violation of a motion on the map from a time on; no violation if it may be driven.
  Violation certify(const Motion& motion, const ObstacleField<2>& obstacles, double from_s) const;

  const FrontEnd& front_end() const { return front_end_; }
  double max_speed() const { return robot_.limits.max_speed; }  ///< [m/s]

 private:
  void drive(const PlanQuery& query, const Opening& opening, const PlanningScene& scene,
             const std::function<bool()>& should_stop, PlanCandidate& candidate) const;
  Motion assemble(const PlanQuery& query, const Opening& opening, PlanarPath curve) const;
  /// Takes the motion as that of the candidate, with what it violates first.
  void prove(const PlanQuery& query, Motion motion, const ObstacleField<2>& obstacles,
             PlanCandidate& candidate) const;

  const RobotModel robot_;
  const PlannerRules rules_;
  const double margin_m_;
  const DriveOptimizer optimizer_;
  const FrontEnd front_end_;
};

}  // namespace mocha
