#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "planning/driven_trail.h"
#include "planning/goal_queue.h"
#include "planning/plan_result.h"
#include "planning/planning_scene.h"

namespace mocha {

/// When to plan and what to drive; each stands in config/global_planner.yaml.
struct PursuitRules {
  double planning_time_s;  ///< a plan takes over this long after planning began
  double replan_period_s;
  double retry_period_s;  ///< after a failure
  double better_by;       ///< of the remaining time, for a plan to replace a valid one
  double occupied_goal_timeout_s;
  GoalRules goals;

  static PursuitRules from(const ParameterTable& values);
};

/// Pursues goals: when to plan, what to ask the planner, which of its plans to drive, and when a
/// goal is reached or given up. Pure decisions: time, measurements and plans come in.
class Pursuit {
 public:
  using Planner = std::function<PlanResult(const PlanQuery&)>;

  enum class Ending { kNone, kReached, kNoProgress, kGoalOccupied };
  struct Planned {
    Goal goal;
    PlanResult result;
  };
  struct Report {
    PlanReason reason = PlanReason::kSolved;
    Violation violation;
    std::string message;
  };
  struct Output {
    std::optional<Planned> planned;  ///< what the planner found, whatever became of it
    std::optional<Report> report;
    Motion plan;                    ///< to be driven from now on; empty: no news
    Ending ending = Ending::kNone;  ///< of all goals
  };

  /// `deceleration` [m/s^2]: of braking where a goal is given up.
  Pursuit(const PursuitRules& rules, double deceleration);
  /// For what is pursued now, too.
  void set_rules(const PursuitRules& rules);

  /// Goals to be reached in order, instead of those there were.
  void take(std::deque<Goal> goals, double now_s);
  /// Plans anew as soon as possible.
  void request() { requested_ = true; }
  /// What is driven instead of what was planned, around something that moves; counts only if it
  /// leads to the goal.
  void follow(Motion followed);
  /// Drops all goals. The plan brakes along what is in force; empty where nothing is.
  Motion stop(const Motion& committed, double now_s);

  /// `committed`: the motion in force, empty if there is none; `planner`: an empty function while
  /// there is no map.
  Output step(double now_s, const RobotState& state, const Motion& committed,
              const Planner& planner);

  /// What would be asked now to get to `goal`; `committed` must not be empty.
  PlanQuery query_to(const Goal& goal, const Motion& committed, double now_s) const;

  bool idle() const { return goals_.empty(); }
  /// The plan at hand; empty if there is none.
  const Motion& plan() const { return plan_; }

 private:
  void begin_goal();
  bool due(double now_s) const;
  bool has_plan(double now_s) const;
  void plan(double now_s, const Motion& committed, const Planner& planner, Output& output);
  bool much_better(const PlanResult& result, double now_s) const;
  void give_up_where_occupied(const PlanResult& result, const Motion& committed, double now_s,
                              Output& output);

  PursuitRules rules_;
  const double deceleration_;
  GoalQueue goals_;
  DrivenTrail trail_;
  Motion plan_;
  double planned_at_s_ = -std::numeric_limits<double>::infinity();
  bool goal_is_new_ = false;
  bool requested_ = false;
  bool retreats_ = false;  // plan_ backs out; the way to the goal is to be found from its end
  std::optional<double> occupied_since_s_;
};

}  // namespace mocha
