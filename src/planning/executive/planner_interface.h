#pragma once

#include <functional>
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
  SceneSource scene;
};

}  // namespace mocha
