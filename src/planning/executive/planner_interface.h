#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planning/candidates/plan_result.h"
#include "planning/candidates/planning_scene.h"

namespace mocha {

/// What is around: surroundings that hold these places (map frame).
using SceneSource = std::function<PlanningScene(const std::vector<Vector2>&)>;

/// What the goal executive asks of planning; all functions are empty while there is no map.
struct PlannerInterface {
  /// A plan, or the reason why there is none.
  std::function<PlanResult(const PlanQuery&)> plan;
  /// A motion back along the trail, to a place from where the query's goal can be reached as far as
  /// the map says; certified. Nothing where there is none.
  std::function<std::optional<Motion>(const PlanQuery&)> back_out;
  SceneSource scene;
};

/// Makes a failure a motion back along the trail: where the robot is at rest, team-mates are not
/// the reason of the failure, and there is such a motion.
void back_out_instead(const PlanQuery& query, const PlannerInterface& planner, PlanResult& result);

}  // namespace mocha
