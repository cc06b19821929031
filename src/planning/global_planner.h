#pragma once

#include <functional>
#include <optional>
#include <string>

#include "planning/candidate_race.h"

namespace mocha {

/// Fig. 2a: ways of different classes, optimised in parallel; the cheapest one that is certified
/// against the map is driven.
class GlobalPlanner {
 public:
  GlobalPlanner(RobotModel robot, const PlannerRules& rules);

  /// `should_stop` ends the work early (it may be called by several threads at once); then the
  /// reason is kBudgetExhausted unless something was certified before.
  PlanResult plan(const PlanQuery& query, const PlanningScene& scene,
                  const std::function<bool()>& should_stop) const;

  /// The first violation of a motion on the map from a time on; no violation if it may be driven.
  Violation certify(const Motion& motion, const ObstacleField<2>& obstacles, double from_s) const {
    return planner_.certify(motion, obstacles, from_s);
  }

 private:
  /// Why there is nothing to plan, if so.
  std::optional<PlanResult> refusal(const PlanQuery& query, const PlanningScene& scene) const;
  std::optional<Vector2> free_goal(const Vector2& goal, const ObstacleField<2>& obstacles) const;
  PlanResult turn_only(const PlanQuery& query, const PlanningScene& scene) const;
  /// Sets the candidates, and takes their winner, if there is one.
  void run(const PlanQuery& query, const Approaches& approaches, const PlanningScene& scene,
           const std::function<bool()>& should_stop, PlanResult& result) const;
  std::optional<Motion> back_out(const PlanQuery& query, const Vector2& goal,
                                 const Terrain& terrain) const;

  const RobotModel robot_;
  const PlannerRules rules_;
  const CandidatePlanner planner_;
};

}  // namespace mocha
