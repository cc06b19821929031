#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planning/candidates/plan_result.h"
#include "planning/local/rejoining.h"
#include "safety/requirement.h"
#include "topology/space_time/space_time_paths.h"

namespace mocha {

/// By less, an earlier arrival is not worth a change [s].
inline constexpr double kSoonerArrival_s = 0.2;

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

/// From start_time_s past everything that moves to the rejoin point, and on along the plan, shifted
/// in time; or why there is no such motion.
struct LocalPlan : Selection {
  LocalPlan() { message = "no plan to come back to"; }

  std::vector<SpaceTimePath> paths;              ///< of the front end, one for each candidate
  RequirementName met = RequirementName::kNone;  ///< by the motion, up to the rejoin point
  RejoinPoint rejoin_point;                      ///< where it is back on the plan, or would be
  double rejoins_s = 0.0;  ///< absolute time at which the motion is at the rejoin point
  double delay_s = 0.0;    ///< by how much it is later there than the plan would have been
  bool late = false;  ///< paper (42): longer than T_epsilon, or as late at a farther rejoin point
  Violation beyond;   ///< what the plan violates after the rejoin point, shifted as it is
};

}  // namespace mocha
