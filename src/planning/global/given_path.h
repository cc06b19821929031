#pragma once

#include <vector>

#include "planning/candidates/planning_scene.h"
#include "trajectory/motion.h"

namespace mocha {

/// The path along which a query asks for a plan, from `from` on. A robot that has not reached its
/// beginning yet goes there by the way that it has promised.
std::vector<Vector2> given_path(const PlanQuery& query, const Vector2& from, double max_speed);

/// Whether there is a path that turns back where it begins and the promise ends, to which the robot
/// still drives, or is yet to set off: it comes to rest there first, whatever the path.
bool turns_back_first(const PlanQuery& query, const MotionState& start);

}  // namespace mocha
