#pragma once

#include <optional>
#include <string>

#include "planning/candidates/plan_result.h"
#include "planning/global/front_end.h"

namespace mocha {

/// Paper Fig. 2a: paths of different classes, optimised in parallel; the cheapest one that is
/// certified against the map is driven.
class GlobalPlanner {
 public:
  GlobalPlanner(RobotModel robot, const PlannerOptions& options);

  /// A plan that joins what is committed, or the reason why there is none.
  ///
  /// Where it is stopped, or the work that each path may take is used up, that is the cheapest
  /// motion that is certified by then, or kBudgetExhausted. That work is counted in evaluations of
  /// single pieces, so many for each second of the query's time limit.
  PlanResult plan(const PlanQuery& query, const PlanningScene& scene) const;

 private:
  /// Why there is nothing to plan, if so.
  std::optional<PlanResult> refusal(const PlanQuery& query, const PlanningScene& scene) const;
  /// Returns the goal where that is free, else the nearest free place around it; none where all
  /// within goal_search_radius of it, and within a quarter of the way to it, is occupied.
  std::optional<Vector2> free_goal(const Vector2& goal, const Vector2& from,
                                   const ObstacleField<2>& obstacles) const;
  /// What is in the way to a goal to which no path leads, in words.
  std::string obstruction(const Vector2& goal, const PlanQuery& query,
                          const StaticMap& static_map) const;
  PlanResult turn_only(const PlanQuery& query, const PlanningScene& scene) const;
  /// Runs with what is promising, then with all that begins where the robot is, then after braking,
  /// then after parking out, until solved.
  void search(const PlanQuery& query, const PlanningScene& scene, const Vector2& goal,
              PlanResult& result) const;
  /// Sets the candidates, and selects one, if there is one to be driven.
  void run(const PlanQuery& query, const GlobalSeeds& seeds, const PlanningScene& scene,
           PlanResult& result) const;

  const RobotModel robot_;
  const PlannerOptions options_;
  const DriveOptimizer optimizer_;
  const FrontEnd front_end_;
};

}  // namespace mocha
