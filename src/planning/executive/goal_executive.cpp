#include "planning/executive/goal_executive.h"

#include <cmath>
#include <utility>

#include "planning/executive/back_out_instead.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

using S = ExecutiveState;
using E = ExecutiveEvent;

constexpr double kSamePlace_m = 0.5;
constexpr double kSameGoal_m = 0.05;
constexpr double kAfterEnd_s = 0.5;   // a plan that ended this long ago without arrival has failed
constexpr double kRounding_s = 1e-6;  // of differences of times

GoalExecutive::Report report(PlanReason reason, const std::string& message,
                             const Violation& violation = {}) {
  GoalExecutive::Report report;
  report.reason = reason;
  report.violation = violation;
  report.message = message;
  return report;
}

}  // namespace

GoalExecutive::GoalExecutive(const GoalExecutiveOptions& options, RobotModel robot,
                             Yielding yielding)
    : options_(options),
      robot_(std::move(robot)),
      yielding_(std::move(yielding), options.goals.tolerance_m),
      goals_(options.goals) {}

void GoalExecutive::set_options(const GoalExecutiveOptions& options,
                                const PlannerOptions& planner) {
  options_ = options;
  yielding_.set_options(planner, options.goals.tolerance_m);
  goals_.set_options(options.goals);
}

// --- goals and states ---

void GoalExecutive::handle(ExecutiveEvent event) {
  if (!heeds(state_, event)) return;
  if (backs_out(state_))
    errand_.plan = Motion();  // it does not lead to where the robot wants to be
  state_ = next_state(state_, event);
}

void GoalExecutive::begin_errand(ExecutiveEvent event, std::optional<PullOverPoint> pull_over) {
  handle(event);
  errand_ = Errand();
  errand_.pull_over = std::move(pull_over);
  yielding_.begin_path();
}

void GoalExecutive::begin_goal(ExecutiveEvent event) {
  begin_errand(event, std::nullopt);
  yielding_.begin_goal(state_ == S::kParked);
}

void GoalExecutive::take(std::deque<Goal> goals, double now_s) {
  goals_.set(std::move(goals), now_s);
  begin_goal(E::kGoalGiven);
}

void GoalExecutive::drop() {
  goals_.clear();
  begin_goal(E::kStopped);
}

Motion GoalExecutive::stop(const Motion& committed, double now_s) {
  drop();
  if (!committed.empty()) errand_.plan = brake(committed, now_s);
  return errand_.plan;
}

void GoalExecutive::follow(Motion followed) {
  if (!heeds(state_, E::kFollowed)) return;
  if ((followed.end_pose().position - destination()).norm() >= kSamePlace_m) return;
  handle(E::kFollowed);
  errand_.plan = std::move(followed);
}

Goal GoalExecutive::target() const {
  return makes_room(state_) ? Goal{errand_.pull_over->position, std::nullopt} : goals_.asked();
}

Vector2 GoalExecutive::destination() const {
  return makes_room(state_) ? errand_.pull_over->position : goals_.current().position;
}

Motion GoalExecutive::brake(const Motion& committed, double now_s) const {
  const double from_s = committed.switch_time(now_s + options_.planning_time_s);
  return Motion(from_s, brake_along(committed, from_s, robot_.braking()));
}

// --- a step ---

GoalExecutive::Output GoalExecutive::step(double now_s, const RobotState& measured,
                                          const Motion& committed,
                                          const PlannerInterface& planner) {
  const Input input{now_s, measured, committed, planner};
  Output output;
  trail_.add(measured);
  output.ending = note_arrival(input);
  if (output.ending == Ending::kNoProgress) output.plan = stop(committed, now_s);
  note_progress(input);
  if (planner.scene && !committed.empty()) yield(input, output);
  if (plan_is_due(now_s)) plan(input, output);
  if (planner.scene) ask(input, output);
  if (auto withdrawal = yielding_.withdrawal()) output.request = std::move(withdrawal);
  return output;
}

GoalExecutive::Ending GoalExecutive::note_arrival(const Input& input) {
  if (errand_.pull_over) goals_.wait(input.now_s);  // to make room is no lack of progress
  switch (goals_.update(input.now_s, input.measured)) {
    case GoalQueue::Event::kAllReached:
      begin_goal(E::kAllReached);
      return Ending::kReached;
    case GoalQueue::Event::kReached:
      begin_goal(E::kGoalReached);
      return Ending::kNone;
    case GoalQueue::Event::kTimedOut:
      return Ending::kNoProgress;
    case GoalQueue::Event::kNone:
      break;
  }
  return Ending::kNone;
}

void GoalExecutive::note_progress(const Input& input) {
  if (drives_plan(state_) && input.now_s >= errand_.plan.end_time() + kAfterEnd_s) {
    handle(E::kPlanEnded);
    errand_.plan = Motion();
  } else if (backs_out(state_) &&
             input.now_s > errand_.plan.end_time() - options_.planning_time_s) {
    handle(E::kPlanEnded);
  }
  if (!errand_.pull_over || !stands(input.measured)) return;
  const Vector2 off = input.measured.pose.position - errand_.pull_over->position;
  if (off.norm() >= options_.goals.tolerance_m) {
    handle(E::kStrayed);
  } else if (goals_.empty()) {
    begin_goal(E::kNoNeedToPullOver);
  } else if (makes_room(state_)) {
    begin_errand(E::kAtPullOverPoint, errand_.pull_over);
  }
}

// --- team-mates ---

RobotIntent GoalExecutive::intent(const RobotState& measured) const {
  const bool drives = drives_plan(state_) || backs_out(state_);
  return {measured, drives ? &errand_.plan : nullptr, errand_.pull_over};
}

void GoalExecutive::yield(const Input& input, Output& output) {
  if (state_ == S::kIdle || !yielding_.due(input.now_s)) return;
  const Motion braking = brake(input.committed, input.now_s);
  const auto advice = yielding_.advise(intent(input.measured), braking.end_pose().position,
                                       input.planner.scene, input.now_s);
  if (advice) follow_advice(*advice, braking, output);
}

void GoalExecutive::follow_advice(const YieldAdvice& advice, const Motion& braking,
                                  Output& output) {
  const bool has_goal = !goals_.empty();
  if (advice.event == E::kWayIsClear) {
    begin_goal(has_goal ? advice.event : E::kNoNeedToPullOver);
    return;
  }
  if (advice.event == E::kNowhereToPullOver) {
    begin_errand(has_goal ? advice.event : E::kNoNeedToPullOver, std::nullopt);
    yielding_.set_stuck(has_goal);
    return;
  }
  begin_errand(advice.event, advice.pull_over);
  if (advice.event == E::kPullOverHere) {
    errand_.plan = braking;
    output.plan = braking;
  }
}

void GoalExecutive::ask(const Input& input, Output& output) {
  if (state_ == S::kIdle || state_ == S::kParked || state_ == S::kWaiting) return;
  output.request =
      yielding_.ask(intent(input.measured), destination(), input.planner.scene, input.now_s);
}

// --- plans ---

PlanQuery GoalExecutive::query_to(const Goal& goal, const Motion& committed, double now_s) const {
  PlanQuery query;
  query.committed = committed;
  query.start_time_s = committed.switch_time(now_s + options_.planning_time_s);
  query.goal = goal.position;
  query.goal_yaw_rad = goal.yaw_rad;
  return query;
}

bool GoalExecutive::plan_is_due(double now_s) const {
  const auto period_s = options_.planning_period_s(state_);
  return period_s && now_s - errand_.planned_s + kRounding_s >= *period_s;
}

void GoalExecutive::plan(const Input& input, Output& output) {
  if (!input.planner.plan) {
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
  errand_.planned_s = input.now_s;
  output.planned = Planned{target(), input.planner.plan(query)};
  PlanResult& result = output.planned->result;
  if (state_ == S::kDriving && !much_better(result, input.now_s)) return;
  if (result.motion.empty()) {
    back_out_instead(query, trail_.points(), options_.backup_distance_m, robot_.limits,
                     input.planner, result);
  }
  if (const auto whose = in_way_of(result.motion, input.now_s)) {
    hold_back(*whose, input, output);
    return;
  }
  output.report = report(result.reason, result.message, result.violation);
  if (result.motion.empty()) {
    fail(result.reason, input, output);
  } else {
    adopt(result, output);
  }
}

/// Quicker by far; or it leads to the goal itself, or farther, than where it was occupied before.
bool GoalExecutive::much_better(const PlanResult& result, double now_s) const {
  if (result.motion.empty()) return false;
  const Vector2& asked = goals_.asked().position;
  const double nearer_m = (goals_.current().position - asked).norm() - (result.goal - asked).norm();
  if (std::abs(nearer_m) > kSameGoal_m) return nearer_m > 0.0;
  const double remaining_s = errand_.plan.end_time() - now_s;
  return result.motion.end_time() <
         errand_.plan.end_time() - options_.min_improvement * remaining_s;
}

/// None while the robot makes room: what leads out of the way may begin in it.
std::optional<Rank> GoalExecutive::in_way_of(const Motion& plan, double now_s) const {
  if (makes_room(state_) || plan.empty()) return std::nullopt;
  return yielding_.in_way_of(plan, now_s);
}

void GoalExecutive::adopt(const PlanResult& result, Output& output) {
  const bool back_out = result.reason == PlanReason::kBackingOut;
  if (makes_room(state_)) {
    output.report->message =
        "makes room for " + errand_.pull_over->whose.agent + ": " + result.message;
  } else {
    errand_.pull_over.reset();
    if (!back_out) goals_.move_current(result.goal);
  }
  handle(back_out ? E::kBackOutFound : E::kPlanFound);
  errand_.plan = result.motion;
  output.plan = result.motion;
}

/// A plan to the goal that would get into the way of a higher rank is not driven; without another
/// at hand, the robot waits where it comes to rest: that place is in no such way, or it would have
/// been told to pull over.
void GoalExecutive::hold_back(const Rank& whose, const Input& input, Output& output) {
  if (drives_plan(state_)) {
    handle(E::kPlanInTheWay);
    return;
  }
  output.report = report(PlanReason::kPeerConflict, "waits until " + whose.agent + " has passed");
  if (state_ == S::kWaiting) return;
  begin_errand(E::kPlanInTheWay, PullOverPoint{input.committed.end_pose().position, whose});
  errand_.planned_s = input.now_s;
}

void GoalExecutive::fail(PlanReason reason, const Input& input, Output& output) {
  if (makes_room(state_)) {
    fail_to_pull_over(input, output);
    return;
  }
  const bool was_occupied = state_ == S::kGoalOccupied;
  handle(reason == PlanReason::kGoalOccupied ? E::kGoalFoundOccupied : E::kNoPlan);
  if (state_ != S::kGoalOccupied) return;
  if (!was_occupied) errand_.occupied_since_s = input.now_s;
  const double occupied_s = input.now_s - errand_.occupied_since_s + kRounding_s;
  if (occupied_s < options_.occupied_goal_timeout_s) return;
  output.ending = Ending::kGoalOccupied;
  output.plan = stop(input.committed, input.now_s);
}

/// Stops, and looks for another place; if there is none, tries again.
void GoalExecutive::fail_to_pull_over(const Input& input, Output& output) {
  handle(E::kNoPlan);
  const Motion braking = brake(input.committed, input.now_s);
  errand_.plan = Motion();
  output.plan = braking;
  const auto other =
      yielding_.pull_over(errand_.pull_over->whose, errand_.pull_over, braking.end_pose().position,
                          input.planner.scene, input.now_s);
  if (!other) return;
  follow_advice(*other, braking, output);
  errand_.planned_s = input.now_s;
}

}  // namespace mocha
