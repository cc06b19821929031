#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planning/candidates/plan_result.h"
#include "planning/candidates/planning_scene.h"

namespace mocha {

/// What is around: surroundings that hold these places (map frame).
using SceneSource = std::function<PlanningScene(const std::vector<Vector2>&)>;

/// What the goal executive asks of planning.
struct PlannerInterface {
  /// Begins a plan; what was begun before is given up. Empty while there is no map, as `scene`.
  std::function<void(const PlanQuery&)> ask;
  /// The plan that was asked for, or the reason why there is none; nothing while it is under way.
  std::function<std::optional<PlanResult>()> answer;
  SceneSource scene;
};

}  // namespace mocha
