#pragma once

#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planning/candidates/plan_kind.h"
#include "planning/executive/executive_state.h"
#include "planning/executive/goal_executive_options.h"
#include "planning/executive/goal_queue.h"
#include "planning/executive/passing_policy.h"
#include "planning/executive/planner_interface.h"

namespace mocha {

/// Takes a robot to its goals: decides when to plan, what to ask the planner, which of its plans to
/// drive, and when a goal is reached or given up. Where robots stand in each other's way, it drives
/// what its PassingPolicy says. What it is about is a state of executive_state.h. Pure decisions:
/// time, measurements and plans come in.
class GoalExecutive {
 public:
  enum class Ending { kNone, kReached, kNoProgress, kGoalOccupied, kUnreachable };
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
    std::optional<Planned> planned;  ///< what was found, whatever became of it
    std::optional<Report> report;
    std::optional<Motion> plan;  ///< from now on; an empty one: there is nothing to drive to
    PlanKind kind = PlanKind::kFree;
    std::vector<PassingMessage> messages;  ///< for team-mates
    Ending ending = Ending::kNone;         ///< of all goals
  };

  GoalExecutive(const GoalExecutiveOptions& options, RobotModel robot, PassingPolicy passing);
  /// Counts for the goals that are there, too.
  void set_options(const GoalExecutiveOptions& options, const PlannerOptions& planner);

  /// Goals to be reached in order, at least one, instead of those there were. Where the first lies
  /// ahead of the motion in force, the robot keeps rolling until it is planned to; else it brakes.
  /// In a patrol, the first follows the last, until there are others or none.
  void take(std::deque<Goal> goals, const Motion& committed, double now_s, bool patrols = false);
  /// Plans anew as soon as possible; what is under way for another reason is given up.
  void request();
  /// What is driven instead of what was planned, around something that moves; counts only if it
  /// leads to the same place.
  void follow(Motion followed);
  /// Drops all goals: there is nothing to drive to from now on.
  void drop();
  /// There is nothing to drive to, though the goals are kept and new ones are taken, until the
  /// robot is to go on.
  void pause();
  void resume();
  /// What a team-mate says.
  void hear(const PassingMessage& message, double now_s) { passing_.hear(message, now_s); }

  /// `committed`: the motion in force, empty if there is none.
  Output step(double now_s, const RobotState& measured, const Motion& committed,
              const PlannerInterface& planner);

  /// The same while nobody knows where the robot is, which may be found out: the goals are kept as
  /// long as without progress.
  Output wait_for_pose(double now_s);

  /// What would be asked now to get to `goal`; `committed` must not be empty.
  PlanQuery query_to(const Goal& goal, const Motion& committed, double now_s) const;

  /// Whether a plan was asked for whose answer still counts.
  bool awaits_plan() const { return errand_.question != nullptr; }

  ExecutiveState state() const { return state_; }
  bool idle() const { return goals_.empty(); }
  const GoalQueue& goals() const { return goals_; }
  /// The plan at hand; empty if there is none.
  const Motion& plan() const { return errand_.plan; }

 private:
  /// Is moot as soon as nobody holds it.
  struct Question {};

  /// Where the robot is to go now, and how far that has come; begins anew with each place.
  struct Errand {
    std::optional<PassingStretch> stretch;  ///< of an order; none: to the goal ...
    std::optional<Goal> turns_at;           ///< ... or only turns there, while it waits
    Motion plan;                            ///< the last one that was found
    double planned_s = -std::numeric_limits<double>::infinity();  ///< the planner was asked last
    std::shared_ptr<const Question> question;  ///< to the planner, until it is answered
    double longer = 1.0;  ///< than usual is the time that planning may take, as it did not suffice
    double without_plan_since_s = 0.0;  ///< for the reason that the state names
  };

  /// What a step is about.
  struct Input {
    double now_s;
    const RobotState& measured;
    const Motion& committed;
    const PlannerInterface& planner;
  };

  void handle(ExecutiveEvent event);
  void begin_errand(ExecutiveEvent event);
  void begin_goal(ExecutiveEvent event);

  // What a step does, in this order.
  Ending note_arrival(const Input& input);
  void note_progress(const Input& input);
  void pass(const Input& input, Output& output);
  void wait_for_turn(const Input& input, Output& output);
  static void keep_promise(const Input& input, Output& output);
  void plan(const Input& input, Output& output);
  void ask_for_plan(const Input& input, Output& output);
  void consider(Planned planned, const Input& input, Output& output);
  void brake_first(const Input& input, Output& output);

  bool is_to_goal() const { return !errand_.stretch && !errand_.turns_at; }
  Goal target() const;
  Vector2 destination() const;
  Motion brake(const Motion& committed, double now_s) const;
  bool brakes(const Motion& committed, double now_s) const;
  bool has_to_brake(const Vector2& goal, const Motion& committed, double now_s) const;
  bool plan_is_due(double now_s) const;
  bool much_better(const PlanResult& result, double now_s) const;
  void adopt(const PlanResult& result, Output& output);
  void fail(PlanReason reason, const Input& input, Output& output);
  void give_up(Ending why, Output& output);

  GoalExecutiveOptions options_;
  const RobotModel robot_;
  PassingPolicy passing_;
  GoalQueue goals_;
  ExecutiveState state_ = ExecutiveState::kIdle;
  Errand errand_;
};

}  // namespace mocha
