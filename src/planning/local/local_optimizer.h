#pragma once

#include <vector>

#include "planning/candidates/drive_optimizer.h"
#include "planning/candidates/start_maneuver.h"
#include "planning/local/local_options.h"
#include "planning/local/local_plan.h"

namespace mocha {

/// Where on the plan a local drive is to end, and about how soon at the earliest.
struct Return {
  RejoinPoint rejoin_point;
  double earliest_s;  ///< after the start of the drive
};

/// Makes a drive of one path through space-time: out of the motion in force and back into the plan,
/// and says what is proved of it.
class LocalOptimizer {
 public:
  LocalOptimizer(const RobotModel& robot, const LocalOptions& options);

  /// The best that any effort gives; it may meet no requirement, and its motion may be empty.
  LocalCandidate optimize(const LocalQuery& query, const LocalScene& scene, const Return& back,
                          const SpaceTimePath& path) const;

  /// The first violation of a requirement by a motion from a time on.
  Violation violation_of(const Motion& motion, const LocalScene& scene, RequirementName required,
                         double from_s) const;

  const Requirements& requirements() const { return requirements_; }

  /// Back at the rejoin point, at about the least time.
  Return return_to(const RejoinPoint& rejoin_point, const LocalQuery& query) const;

 private:
  /// How to begin on a path: at once, or after braking and turning.
  std::vector<StartManeuver> start_maneuvers(const LocalQuery& query,
                                             std::vector<Vector2> path) const;
  const MotionLimits& limits_of(const LocalQuery& query) const {
    return *requirements_[query.wanted].limits;
  }
  void drive(const LocalQuery& query, const LocalScene& scene, const Return& back,
             const StartManeuver& start_maneuver, LocalCandidate& candidate) const;
  /// Says what the candidate's motion meets before it is back on the plan, and else why not.
  void grade(const LocalQuery& query, const LocalScene& scene, LocalCandidate& candidate) const;

  const Requirements requirements_;
  const Footprint footprint_;
  const double mu_s_;
  const double weight_delay_;
  const double smooth_start_rad_;
  const DriveOptimizer optimizer_;
};

}  // namespace mocha
