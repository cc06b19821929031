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
#include "planning/right_of_way.h"
#include "planning/way_asking.h"

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

/// Whom to ask for plans and for what is around; empty functions while there is no map.
struct Outlook {
  std::function<PlanResult(const PlanQuery&)> plan;
  /// Surroundings that hold these places.
  std::function<PlanningScene(const std::vector<Vector2>&)> scene;
};

/// Pursues goals: when to plan, what to ask the planner, which of its plans to drive, and when a
/// goal is reached or given up. Where team-mates stand in its way, it asks for it; where it is in
/// the way of a higher one, it makes room first, and so it does where it has reached its goal,
/// until it is told to stop, or stopped. Pure decisions: time, measurements and plans come in.
class Pursuit {
 public:
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
    Motion plan;                        ///< to be driven from now on; empty: no news
    std::optional<WayRequest> request;  ///< for all team-mates
    Ending ending = Ending::kNone;      ///< of all goals
  };

  /// `deceleration` [m/s^2]: of braking where a goal is given up, or room is to be made.
  Pursuit(const PursuitRules& rules, double deceleration, RightOfWay right_of_way);
  /// For what is pursued now, too.
  void set_rules(const PursuitRules& rules, const PlannerRules& planner);

  /// Goals to be reached in order, instead of those there were.
  void take(std::deque<Goal> goals, double now_s);
  /// Plans anew as soon as possible.
  void request() { requested_ = true; }
  /// What is driven instead of what was planned, around something that moves; counts only if it
  /// leads to the goal.
  void follow(Motion followed);
  /// Drops all goals. The plan brakes along what is in force; empty where nothing is.
  Motion stop(const Motion& committed, double now_s);
  /// Drops all goals and the plan, where something else stops the robot.
  void drop();

  /// What a team-mate asks for.
  void hear(const WayRequest& request, double now_s) { right_of_way_.hear(request, now_s); }

  /// `committed`: the motion in force, empty if there is none.
  Output step(double now_s, const RobotState& state, const Motion& committed,
              const Outlook& outlook);

  /// What would be asked now to get to `goal`; `committed` must not be empty.
  PlanQuery query_to(const Goal& goal, const Motion& committed, double now_s) const;

  bool idle() const { return goals_.empty(); }
  /// The plan at hand; empty if there is none.
  const Motion& plan() const { return plan_; }

 private:
  /// Where it leaves the way to a higher one.
  struct Refuge {
    Vector2 place;
    Rank whose;
    bool there = false;         ///< it waits there
    bool out_of_reach = false;  ///< no way there was found
  };

  void begin_goal();
  void begin_way();
  Ending ending_of(GoalQueue::Event event);
  /// It is to go somewhere, to its refuge or to the goal.
  bool has_errand() const { return makes_room() || !goals_.empty(); }
  bool makes_room() const { return refuge_ && !refuge_->there; }
  Goal target() const;
  bool due(double now_s) const;
  bool has_plan(double now_s) const;
  void plan(double now_s, const Motion& committed, const Outlook& outlook, Output& output);
  void adopt(const PlanResult& result, Output& output);
  bool waits_for_others(const PlanResult& result, const Motion& committed, double now_s,
                        Output& output);
  bool much_better(const PlanResult& result, double now_s) const;
  void on_failure(const PlanResult& result, const Motion& committed, double now_s, Output& output);
  void make_room(double now_s, const RobotState& state, const Motion& committed,
                 const Outlook& outlook, Output& output);
  std::optional<Rank> in_way_of(double now_s, const RobotState& state) const;
  Motion brake(const Motion& committed, double now_s) const;
  void ask(double now_s, const RobotState& state, const Outlook& outlook, Output& output);
  std::vector<Vector2> wanted_way(double now_s, const RobotState& state,
                                  const PlanningScene& scene) const;

  PursuitRules rules_;
  const double deceleration_;
  RightOfWay right_of_way_;
  WayAsking asking_;
  GoalQueue goals_;
  DrivenTrail trail_;
  Motion plan_;
  double planned_at_s_ = -std::numeric_limits<double>::infinity();
  bool way_is_new_ = false;
  bool requested_ = false;
  bool retreats_ = false;  // plan_ backs out; the way to the goal is to be found from its end
  bool parked_ = false;    // it has reached its goals, and nobody said otherwise since
  std::optional<double> occupied_since_s_;
  std::optional<Refuge> refuge_;
  double looked_s_ = -std::numeric_limits<double>::infinity();  // whether it is in the way
};

}  // namespace mocha
