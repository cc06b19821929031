#pragma once

#include <vector>

#include "planning/executive/planner_interface.h"
#include "world/robot_model.h"

namespace mocha {

/// Makes a failure a slow drive of about `length_m` back along the trail (newest last): where the
/// robot is at rest, team-mates are not the reason of the failure, and that drive leads on.
void back_out_instead(const PlanQuery& query, const std::vector<Vector2>& trail, double length_m,
                      const MotionLimits& limits, const PlannerInterface& planner,
                      PlanResult& result);

}  // namespace mocha
