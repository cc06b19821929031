#pragma once

#include <vector>

#include "planning/drive_optimizer.h"
#include "planning/local_plan.h"
#include "planning/local_rules.h"
#include "planning/opening.h"

namespace mocha {

/// Where on the plan a local drive is to end, and about how soon at the earliest.
struct Return {
  RejoiningPoint anchor;
  double earliest_s;  ///< after the start of the drive
};

/// Makes a drive of one way through space-time: out of the motion in force and back into the plan,
/// and says what is proved of it.
class LocalOptimizer {
 public:
  LocalOptimizer(const RobotModel& robot, const LocalRules& rules);

  /// The best that any effort gives; its proof may be kNone, and its motion empty.
  LocalCandidate optimize(const LocalQuery& query, const LocalScene& scene, const Return& back,
                          const SpaceTimeWay& way) const;

  /// The first violation of a motion from a time on, of what is asked for.
  Violation violation_of(const Motion& motion, const LocalScene& scene, double from_s) const;

  /// Back at the anchor, at about the least time.
  Return return_to(const RejoiningPoint& anchor, const LocalQuery& query) const;

 private:
  /// How to begin on a way: at once, or after braking and turning.
  std::vector<Opening> openings(const LocalQuery& query, std::vector<Vector2> path) const;
  void drive(const LocalQuery& query, const LocalScene& scene, const Return& back,
             const Opening& opening, LocalCandidate& candidate) const;
  Violation certify(const Motion& motion, const std::vector<MovingThing>& moving,
                    double from_s) const;
  /// Up to until_s, which is the beginning of what is only planned.
  LocalProof proof_of(const Motion& motion, const LocalScene& scene, double from_s, double until_s,
                      Violation& violation) const;

  const RobotModel robot_;
  const MotionLimits emergency_limits_;
  const double mu_s_;
  const double margin_m_;
  const DriveOptimizer optimizer_;
  const Openings openings_;
};

}  // namespace mocha
