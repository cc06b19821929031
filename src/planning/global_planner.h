#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "planning/drive_optimizer.h"
#include "planning/plan_result.h"
#include "safety/margin_budget.h"
#include "topology/grid_path.h"
#include "world/distance_field.h"

namespace mocha {

/// What is around: the map's obstacles (unknown space counts as free) and the team-mates.
struct PlanningScene {
  std::shared_ptr<const DistanceField> obstacles;
  std::vector<std::shared_ptr<const MovingObstacle>> peers;
};

/// From where, from when and to where. Map frame, absolute times.
struct PlanQuery {
  double start_time_s = 0.0;
  /// What the robot is bound to do; the plan joins it at start_time_s (a switch time of the
  /// motion).
  Motion committed;
  Vector2 goal = Vector2::Zero();
  std::optional<double> goal_yaw_rad;
  /// Where the robot came from, newest last; used to back out.
  std::vector<Vector2> trail;
};

/// Fig. 2a: front-end path, optimisation, proof. The motion returned is certified against the map.
class GlobalPlanner {
 public:
  GlobalPlanner(RobotModel robot, const PlannerRules& rules);

  /// `should_stop` ends the work early; then the reason is kBudgetExhausted unless something was
  /// certified before.
  PlanResult plan(const PlanQuery& query, const PlanningScene& scene,
                  const std::function<bool()>& should_stop) const;

  /// The first violation of a motion on the map from a time on; no violation if it may be driven.
  Violation certify(const Motion& motion, const DistanceField& obstacles, double from_s) const;

 private:
  /// How a plan may begin before the optimised drive: brake, turn in place, or nothing.
  struct Opening {
    std::vector<Phase> phases;
    double duration_s = 0.0;
    PlanarMinco::State state;   ///< where the drive begins
    std::vector<Vector2> path;  ///< front-end path from there to the goal
  };

  /// Where the centre of the robot must not be because of a team-mate at a time.
  BlockedDisc kept_from(const MovingObstacle& peer, double t) const;
  GridPath find_path(const Vector2& start, const Vector2& goal, double start_time_s,
                     const PlanningScene& scene) const;
  std::vector<Opening> openings(const PlanQuery& query, const PlanningScene& scene,
                                const Vector2& goal) const;
  Opening from_rest(std::vector<Phase> phases, const Pose& pose, std::vector<Vector2> path,
                    bool smooth) const;
  PlanCandidate drive_to(const PlanQuery& query, const Opening& opening, const PlanningScene& scene,
                         const std::function<bool()>& should_stop) const;
  Motion assemble(const PlanQuery& query, const Opening& opening, PlanarPath curve) const;
  /// Takes the motion as that of the candidate, with what it violates first.
  void prove(const PlanQuery& query, Motion motion, const DistanceField& obstacles,
             PlanCandidate& candidate) const;
  std::optional<Motion> back_out(const PlanQuery& query, const Vector2& goal,
                                 const PlanningScene& scene) const;
  std::optional<Vector2> free_goal(const Vector2& goal, const DistanceField& obstacles) const;
  PlanResult turn_only(const PlanQuery& query, const PlanningScene& scene) const;
  double required_clearance_m() const;

  const RobotModel robot_;
  const PlannerRules rules_;
  const MarginBudget margins_;
  const DriveOptimizer optimizer_;
};

}  // namespace mocha
