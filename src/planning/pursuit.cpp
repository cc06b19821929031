#include "planning/pursuit.h"

#include <cmath>
#include <utility>

#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kSoonest_s = 0.2;  // between two plans, whoever asks
constexpr double kSamePlace_m = 0.5;
constexpr double kSameGoal_m = 0.05;
constexpr double kAfterEnd_s = 0.5;   // a plan that ended this long ago without arrival has failed
constexpr double kRounding_s = 1e-6;  // of differences of times

}  // namespace

PursuitRules PursuitRules::from(const ParameterTable& values) {
  return {values.number("planning_time"),         values.number("replan_period"),
          values.number("retry_period"),          values.number("better_by"),
          values.number("occupied_goal_timeout"), GoalRules::from(values)};
}

Pursuit::Pursuit(const PursuitRules& rules, double deceleration)
    : rules_(rules), deceleration_(deceleration), goals_(rules.goals) {}

void Pursuit::set_rules(const PursuitRules& rules) {
  rules_ = rules;
  goals_.set_rules(rules.goals);
}

void Pursuit::take(std::deque<Goal> goals, double now_s) {
  goals_.set(std::move(goals), now_s);
  begin_goal();
}

void Pursuit::begin_goal() {
  plan_ = Motion();
  retreats_ = false;
  goal_is_new_ = true;
  occupied_since_s_.reset();
}

void Pursuit::follow(Motion followed) {
  if (goals_.empty() || goal_is_new_ || retreats_) return;
  const Vector2 end = followed.end_pose().position;
  if ((end - goals_.current().position).norm() < kSamePlace_m) plan_ = std::move(followed);
}

Motion Pursuit::stop(const Motion& committed, double now_s) {
  goals_.clear();
  if (committed.empty()) return {};
  const double from_s = committed.switch_time(now_s + rules_.planning_time_s);
  plan_ = Motion(from_s, brake_along(committed, from_s, deceleration_));
  return plan_;
}

Pursuit::Output Pursuit::step(double now_s, const RobotState& state, const Motion& committed,
                              const Planner& planner) {
  Output output;
  trail_.add(state);
  if (goals_.empty()) return output;
  switch (goals_.update(now_s, state)) {
    case GoalQueue::Event::kAllReached:
      output.ending = Ending::kReached;
      return output;
    case GoalQueue::Event::kReached:
      begin_goal();
      break;
    case GoalQueue::Event::kTimedOut:
      output.ending = Ending::kNoProgress;
      output.plan = stop(committed, now_s);
      return output;
    case GoalQueue::Event::kNone:
      break;
  }
  if (due(now_s)) plan(now_s, committed, planner, output);
  return output;
}

bool Pursuit::has_plan(double now_s) const {
  return !plan_.empty() && now_s < plan_.end_time() + kAfterEnd_s;
}

bool Pursuit::due(double now_s) const {
  const double since_s = now_s - planned_at_s_ + kRounding_s;
  if (goal_is_new_) return true;
  const bool retreat_ends = retreats_ && now_s > plan_.end_time() - rules_.planning_time_s;
  if (requested_ || retreat_ends) return since_s >= kSoonest_s;
  if (retreats_) return false;
  return since_s >= (has_plan(now_s) ? rules_.replan_period_s : rules_.retry_period_s);
}

PlanQuery Pursuit::query_to(const Goal& goal, const Motion& committed, double now_s) const {
  PlanQuery query;
  query.committed = committed;
  query.start_time_s = committed.switch_time(now_s + rules_.planning_time_s);
  query.goal = goal.position;
  query.goal_yaw_rad = goal.yaw_rad;
  query.trail = trail_.points();
  return query;
}

void Pursuit::plan(double now_s, const Motion& committed, const Planner& planner, Output& output) {
  if (!planner || committed.empty()) {
    output.report = Report();
    output.report->reason = planner ? PlanReason::kNoPose : PlanReason::kNoMap;
    output.report->message =
        planner ? "nothing is committed yet that a plan could start from" : "no map yet";
    return;
  }
  PlanQuery query = query_to(goals_.asked(), committed, now_s);
  if (!goal_is_new_ && !retreats_) query.driven = plan_;
  output.planned = Planned{goals_.asked(), planner(query)};
  const PlanResult& result = output.planned->result;
  const bool improvement = !goal_is_new_ && !requested_ && !retreats_ && has_plan(now_s);
  planned_at_s_ = now_s;
  requested_ = false;
  if (improvement && (result.motion.empty() || !much_better(result, now_s))) return;
  output.report = Report{result.reason, result.violation, result.message};
  goal_is_new_ = false;
  if (result.motion.empty()) {
    give_up_where_occupied(result, committed, now_s, output);
    return;
  }
  occupied_since_s_.reset();
  retreats_ = result.reason == PlanReason::kBackingOut;
  if (!retreats_) goals_.move_current(result.goal);
  plan_ = result.motion;
  output.plan = plan_;
}

/// Quicker by far; or it leads to the goal itself, or farther, than where it was occupied before.
bool Pursuit::much_better(const PlanResult& result, double now_s) const {
  const Vector2& asked = goals_.asked().position;
  const double nearer_m = (goals_.current().position - asked).norm() - (result.goal - asked).norm();
  if (std::abs(nearer_m) > kSameGoal_m) return nearer_m > 0.0;
  const double remaining_s = plan_.end_time() - now_s;
  return result.motion.end_time() < plan_.end_time() - rules_.better_by * remaining_s;
}

void Pursuit::give_up_where_occupied(const PlanResult& result, const Motion& committed,
                                     double now_s, Output& output) {
  if (result.reason != PlanReason::kGoalOccupied) {
    occupied_since_s_.reset();
    return;
  }
  if (!occupied_since_s_) occupied_since_s_ = now_s;
  if (now_s - *occupied_since_s_ < rules_.occupied_goal_timeout_s) return;
  output.ending = Ending::kGoalOccupied;
  output.plan = stop(committed, now_s);
}

}  // namespace mocha
