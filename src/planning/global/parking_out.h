#pragma once

#include <vector>

#include "planning/candidates/planning_scene.h"
#include "topology/static_map/travel_cost.h"
#include "trajectory/motion.h"
#include "world/robot_model.h"

namespace mocha {

/// Drives and turns by which a robot that rests at `start` gets to where it can turn round on the
/// spot, as near as can be; on ground that was seen free, if that leads there. From rest to rest,
/// slowly. Empty where it can turn round already, and where no way out is found.
///
/// The base keeps out of the `blocked` discs, of standing team-mates; where it rests in one, it
/// does not come closer.
std::vector<Phase> park_out(const Pose& start, const RobotModel& robot, const PlanningScene& scene,
                            const std::vector<BlockedDisc>& blocked);

}  // namespace mocha
