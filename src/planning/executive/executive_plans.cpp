// What the goal executive makes of plans, and of their lack.
#include <algorithm>
#include <cmath>
#include <utility>

#include "planning/executive/goal_executive.h"

namespace mocha {
namespace {

using S = ExecutiveState;
using E = ExecutiveEvent;

constexpr double kSameGoal_m = 0.05;
constexpr double kRounding_s = 1e-6;  // of differences of times
constexpr double kLonger = 2.0;       // the time for planning, each time that it did not suffice
constexpr double kLongest = 16.0;     // times as usual
constexpr double kLongestUnderWay = 4.0;  // a promise may have been extended later than that

GoalExecutive::Report report(PlanReason reason, const std::string& message,
                             const Violation& violation = {}) {
  GoalExecutive::Report report;
  report.reason = reason;
  report.violation = violation;
  report.message = message;
  return report;
}

E failure_event(PlanReason reason) {
  if (reason == PlanReason::kGoalOccupied) return E::kGoalFoundOccupied;
  if (reason == PlanReason::kNoPath) return E::kNoPathFound;
  return E::kNoPlan;
}

}  // namespace

PlanQuery GoalExecutive::query_to(const Goal& goal, const Motion& committed, double now_s) const {
  PlanQuery query;
  query.committed = committed;
  const double usual_s = options_.planning_time_s;
  const bool rests = committed.at(committed.switch_time(now_s + usual_s)).at_rest;
  const double planning_time_s =
      usual_s * std::min(errand_.longer, rests ? kLongest : kLongestUnderWay);
  query.start_time_s = committed.switch_time(now_s + planning_time_s);
  // From rest, a plan may take over later.
  query.time_limit_s = planning_time_s - (rests ? 0.0 : options_.handover_s);
  query.goal = goal.position;
  query.goal_yaw_rad = goal.yaw_rad;
  return query;
}

bool GoalExecutive::plan_is_due(double now_s) const {
  const auto period_s = options_.planning_period_s(state_);
  return period_s && now_s - errand_.planned_s + kRounding_s >= *period_s;
}

void GoalExecutive::plan(const Input& input, Output& output) {
  if (!errand_.question && plan_is_due(input.now_s)) ask_for_plan(input, output);
  if (!errand_.question) return;
  std::optional<PlanResult> answer = input.planner.answer();
  if (!answer) return;
  errand_.question.reset();
  const bool exhausted = answer->reason == PlanReason::kBudgetExhausted;
  errand_.longer = exhausted ? std::min(kLonger * errand_.longer, kLongest)
                             : std::max(errand_.longer / kLonger, 1.0);
  consider({target(), std::move(*answer)}, input, output);
}

void GoalExecutive::ask_for_plan(const Input& input, Output& output) {
  if (!input.planner.ask) {
    output.report = report(PlanReason::kNoMap, "no map yet");
    return;
  }
  if (input.committed.empty()) {
    output.report =
        report(PlanReason::kNoPose, "nothing is committed yet that a plan could start from");
    return;
  }
  PlanQuery query = query_to(target(), input.committed, input.now_s);
  query.driven = errand_.plan;
  if (errand_.stretch) query.along = errand_.stretch->path;
  errand_.planned_s = input.now_s;
  errand_.question = std::make_shared<Question>();
  query.should_stop = [asked = std::weak_ptr(errand_.question)] { return asked.expired(); };
  input.planner.ask(query);
}

/// What a plan that came in means for what is driven.
void GoalExecutive::consider(Planned planned, const Input& input, Output& output) {
  output.planned = std::move(planned);
  const PlanResult& result = output.planned->result;
  if (state_ == S::kDriving && !much_better(result, input.now_s)) return;
  output.report = report(result.reason, result.message, result.violation);
  if (result.motion.empty()) {
    fail(result.reason, input, output);
  } else {
    adopt(result, output);
  }
}

/// Quicker by far; or it leads to the goal itself, or farther, than where it was occupied before.
bool GoalExecutive::much_better(const PlanResult& result, double now_s) const {
  if (result.motion.empty() || errand_.turns_at) return false;
  if (is_to_goal()) {
    const Vector2& asked = goals_.asked().position;
    const double nearer_m =
        (goals_.current().position - asked).norm() - (result.goal - asked).norm();
    if (std::abs(nearer_m) > kSameGoal_m) return nearer_m > 0.0;
  }
  const double remaining_s = errand_.plan.end_time() - now_s;
  return result.motion.end_time() <
         errand_.plan.end_time() - options_.min_improvement * remaining_s;
}

void GoalExecutive::adopt(const PlanResult& result, Output& output) {
  if (!is_to_goal()) {
    output.report->message = "passes others in turn: " + result.message;
  } else {
    goals_.move_current(result.goal);
  }
  handle(E::kPlanFound);
  errand_.plan = result.motion;
  output.plan = result.motion;
  output.kind = errand_.stretch ? PlanKind::kInTurn : PlanKind::kFree;
}

void GoalExecutive::fail(PlanReason reason, const Input& input, Output& output) {
  const S before = state_;
  handle(is_to_goal() ? failure_event(reason) : E::kNoPlan);
  if (drives_plan(state_)) return;
  if (state_ != before) {
    errand_.without_plan_since_s = input.now_s;
    if (errand_.stretch) {
      keep_promise(input, output);
    } else {
      output.plan = Motion();
    }
  }
  const auto patience_s = options_.patience_s(state_);
  if (!patience_s || input.now_s - errand_.without_plan_since_s + kRounding_s < *patience_s) return;
  give_up(state_ == S::kGoalOccupied ? Ending::kGoalOccupied : Ending::kUnreachable, output);
}

void GoalExecutive::give_up(Ending why, Output& output) {
  drop();
  output.ending = why;
  output.plan = Motion();
}

}  // namespace mocha
