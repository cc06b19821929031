#pragma once

#include <vector>

#include "planning/candidates/maneuver.h"

namespace mocha {

/// What a search keeps from what moves.
struct Keeping {
  double share;   ///< of the clearance
  double growth;  ///< [m/s] more and more of it, for a second
};

/// How a search goes about.
struct RollingSearchOptions {
  MotionLimits limits;            ///< within which ways keep
  double join_s;                  ///< where they leave the committed motion
  double duration_s;              ///< of a way, before it brakes to rest
  double stands_s;                ///< so long after it nobody may come, as far as is predicted
  std::vector<Keeping> keepings;  ///< tried in this order
};

/// Ways between all that moves and what stands or was not seen, by a search in space and time over
/// what a unicycle can do (hybrid A*, Dolgov et al. 2010), forward only: turning to either side,
/// faster, at its speed or braking, again and again, and at last braking to rest. From rest it
/// turns in place first; a turn that is under way it ends before. Of what it is too near already,
/// it keeps the distance that there is.
///
/// Returns the first few of them, those that get the nearest to the target first, with the first
/// keeping that has any; empty where there is none, and where the robot drives backward.
std::vector<Motion> rolling_ways(const ManeuverStart& start, const RollingSearchOptions& options);

}  // namespace mocha
