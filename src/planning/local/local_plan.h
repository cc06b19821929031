#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planning/candidates/local_scene.h"
#include "planning/candidates/plan_result.h"
#include "planning/local/rejoining.h"
#include "safety/requirement.h"
#include "topology/space_time/space_time_paths.h"

namespace mocha {

/// Out of which motion, and back into which plan. Map frame, absolute times.
struct LocalQuery {
  Motion committed;
  double start_time_s = 0.0;  ///< the local drive leaves `committed` here, a switch time of it
  Motion plan;
  double progress_s = 0.0;  ///< time of the plan at which it is where the robot is
  Motion driven;            ///< what is being followed, for its class; may be empty
  double rejoin_point_s =
      0.0;  ///< time of the plan at which `driven` comes back to it; 0: never left
  /// What the search is for; where nothing meets it, what meets a lesser requirement is found, too.
  RequirementName wanted = RequirementName::kDetour;
};

/// One path through space-time that was optimised, certified or not.
struct LocalCandidate {
  TimedPath path;  ///< of the front end, from which the optimisation started
  Signature signature;
  PlanReason reason = PlanReason::kNotCertified;
  RequirementName met = RequirementName::kNone;  ///< up to the rejoin point, the most demanding
  Violation violation;  ///< the first one before the rejoin point, of what was wanted
  double cost = 0.0;    ///< J, paper (14), with paper (39), paper (40)
  CostTerms terms;
  Motion motion;         ///< up to the plan's end
  double rejoins_s = 0;  ///< absolute time at which it is back on the plan
  bool driven = false;   ///< of the class that the plan itself has
  bool selected = false;
};

struct LocalPlan {
  PlanReason reason = PlanReason::kNoPath;  ///< kSolved: there is a motion that is certified
  std::string message = "no plan to come back to";
  Violation violation;  ///< of the first candidate, where none is certified
  RequirementName met = RequirementName::kNone;  ///< by the motion, up to the rejoin point
  /// From start_time_s past everything that moves to the rejoin point, and on along the plan,
  /// shifted in time; empty unless solved.
  Motion motion;
  RejoinPoint rejoin_point;  ///< where it is back on the plan, or would be
  double rejoins_s = 0.0;    ///< absolute time at which the motion is at the rejoin point
  double delay_s = 0.0;      ///< by how much it is later there than the plan would have been
  bool late = false;  ///< paper (42): longer than T_epsilon, or as late at a farther rejoin point
  Violation beyond;   ///< what the plan violates after the rejoin point, shifted as it is
  bool switches_class = false;  ///< other than the plan's
  std::vector<LocalCandidate> candidates;
};

}  // namespace mocha
