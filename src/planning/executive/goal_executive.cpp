#include "planning/executive/goal_executive.h"

#include <cmath>
#include <utility>

#include "planning/candidates/start_maneuver.h"
#include "trajectory/plane_vectors.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

using S = ExecutiveState;
using E = ExecutiveEvent;

constexpr double kSamePlace_m = 0.5;
constexpr double kAfterEnd_s = 0.5;  // a plan that ended this long ago without arrival has failed
constexpr double kSooner_s = 0.1;    // by less, a stop is no sooner than what is in force
constexpr double kTurned_rad = 0.1;

/// In which a robot drives off along a way, forward or backward, with the smaller turn.
double setting_off_rad(double way_rad, double yaw_rad, bool may_back) {
  const bool backward = may_back && std::abs(wrap_angle(way_rad - yaw_rad)) > M_PI_2;
  return backward ? wrap_angle(way_rad + M_PI) : way_rad;
}

}  // namespace

GoalExecutive::GoalExecutive(const GoalExecutiveOptions& options, RobotModel robot,
                             PassingPolicy passing)
    : options_(options),
      robot_(std::move(robot)),
      passing_(std::move(passing)),
      goals_(options.goals) {}

void GoalExecutive::set_options(const GoalExecutiveOptions& options,
                                const PlannerOptions& planner) {
  options_ = options;
  passing_.set_options(planner);
  goals_.set_options(options.goals);
}

// --- goals and states ---

void GoalExecutive::handle(ExecutiveEvent event) { state_ = next_state(state_, event); }

void GoalExecutive::begin_errand(ExecutiveEvent event) {
  handle(event);
  errand_ = Errand();
}

/// What was ordered was made for another goal.
void GoalExecutive::begin_goal(ExecutiveEvent event) {
  begin_errand(event);
  passing_.begin_goal();
}

void GoalExecutive::take(std::deque<Goal> goals, const Motion& committed, double now_s,
                         bool patrols) {
  goals_.set(std::move(goals), now_s, patrols);
  const bool brakes = has_to_brake(goals_.asked().position, committed, now_s);
  begin_goal(brakes ? E::kGoalBehind : E::kGoalGiven);
}

void GoalExecutive::drop() {
  goals_.clear();
  begin_goal(E::kStopped);
}

void GoalExecutive::pause() { begin_goal(E::kPaused); }

void GoalExecutive::resume() {
  if (!heeds(state_, E::kResumed)) return;
  begin_goal(E::kResumed);
  if (goals_.empty()) begin_goal(E::kStopped);
}

void GoalExecutive::request() {
  const S before = state_;
  handle(E::kPlanRequested);
  if (state_ != before) errand_.question.reset();
}

void GoalExecutive::follow(Motion followed) {
  if (!heeds(state_, E::kFollowed)) return;
  if ((followed.end_pose().position - destination()).norm() >= kSamePlace_m) return;
  handle(E::kFollowed);
  errand_.plan = std::move(followed);
}

Goal GoalExecutive::target() const {
  if (errand_.turns_at) return *errand_.turns_at;
  return errand_.stretch ? Goal{errand_.stretch->end(), std::nullopt} : goals_.asked();
}

Vector2 GoalExecutive::destination() const {
  if (errand_.turns_at) return errand_.turns_at->position;
  return errand_.stretch ? errand_.stretch->end() : goals_.current().position;
}

Motion GoalExecutive::brake(const Motion& committed, double now_s) const {
  const double from_s = committed.switch_time(now_s + options_.planning_time_s);
  return Motion(from_s, brake_along(committed, from_s, robot_.braking()));
}

/// Whether braking would bring the motion in force to rest no sooner than it comes by itself.
bool GoalExecutive::brakes(const Motion& committed, double now_s) const {
  return committed.empty() || brake(committed, now_s).end_time() > committed.end_time() - kSooner_s;
}

/// Whether the goal lies behind, or so near that the robot cannot stop before it. A robot that
/// stands has to, too, unless it is sure to stay: it may be about to set off elsewhere.
bool GoalExecutive::has_to_brake(const Vector2& goal, const Motion& committed, double now_s) const {
  if (committed.empty()) return false;
  const bool stays = state_ == S::kIdle || state_ == S::kParked;
  if (stays && committed.at(now_s).at_rest && brakes(committed, now_s)) return false;
  const Motion stop = brake(committed, now_s);
  const Vector2 velocity = stop.velocity(stop.start_time());
  const Vector2 way = goal - stop.end_pose().position;
  return velocity.isZero() || std::abs(angle_between(velocity, way)) > kRollingStart_rad;
}

// --- a step ---

GoalExecutive::Output GoalExecutive::step(double now_s, const RobotState& measured,
                                          const Motion& committed,
                                          const PlannerInterface& planner) {
  const Input input{now_s, measured, committed, planner};
  Output output;
  output.ending = note_arrival(input);
  if (output.ending == Ending::kNoProgress) give_up(output.ending, output);
  note_progress(input);
  if (planner.scene && !committed.empty()) pass(input, output);
  plan(input, output);
  brake_first(input, output);
  return output;
}

GoalExecutive::Output GoalExecutive::wait_for_pose(double now_s) {
  Output output;
  if (state_ == S::kPaused) goals_.wait(now_s);
  if (!goals_.empty() && goals_.overdue(now_s)) give_up(Ending::kNoProgress, output);
  return output;
}

GoalExecutive::Ending GoalExecutive::note_arrival(const Input& input) {
  // Keeping to an order and pausing do not count as lack of progress, nor a goal on the way as
  // reached.
  if (passing_.follows() || state_ == S::kPaused) {
    goals_.wait(input.now_s);
    return Ending::kNone;
  }
  switch (goals_.update(input.now_s, input.measured)) {
    case GoalQueue::Event::kAllReached:
      begin_errand(E::kAllReached);
      return Ending::kReached;
    case GoalQueue::Event::kReached:
      begin_errand(E::kGoalReached);
      return Ending::kNone;
    case GoalQueue::Event::kTimedOut:
      return Ending::kNoProgress;
    case GoalQueue::Event::kNone:
      break;
  }
  return Ending::kNone;
}

void GoalExecutive::note_progress(const Input& input) {
  if (!drives_plan(state_) || input.now_s < errand_.plan.end_time() + kAfterEnd_s) return;
  handle(E::kPlanEnded);
  errand_.plan = Motion();
}

/// Says so again until the motion in force is the braking: a plan has to begin there.
void GoalExecutive::brake_first(const Input& input, Output& output) {
  if (state_ != S::kBraking) return;
  output.plan = Motion();
  if (brakes(input.committed, input.now_s)) handle(E::kBrakes);
}

// --- team-mates ---

void GoalExecutive::pass(const Input& input, Output& output) {
  if (!takes_part(state_)) return passing_.stay_out();
  const std::optional<Vector2> goal =
      goals_.empty() ? std::nullopt : std::optional(goals_.asked().position);
  output.messages =
      passing_.step({input.now_s, input.measured, input.committed, goal}, input.planner.scene);
  const auto& stretch = passing_.stretch();
  if (passing_.holds()) {
    if (goal) wait_for_turn(input, output);
  } else if (!passing_.follows()) {
    if (state_ != S::kWaiting && is_to_goal()) return;
    begin_errand(goal ? E::kPassed : E::kPassedToTheEnd);
    if (goal) errand_.plan = input.committed;
    keep_promise(input, output);
  } else if (!stretch) {
    wait_for_turn(input, output);
  } else if (!errand_.stretch || !errand_.stretch->ends_with(*stretch)) {
    begin_errand(E::kTurn);
    errand_.stretch = stretch;
  }
}

/// Drives what is promised, and no farther.
void GoalExecutive::keep_promise(const Input& input, Output& output) {
  output.plan = input.committed;
  output.kind = PlanKind::kInTurn;
}

/// Turns to where it will go on.
void GoalExecutive::wait_for_turn(const Input& input, Output& output) {
  const Pose& pose = input.measured.pose;
  auto heading_rad = passing_.next_heading_rad();
  if (heading_rad) heading_rad = setting_off_rad(*heading_rad, pose.yaw_rad, robot_.may_back());
  const bool is_turned =
      !heading_rad || std::abs(wrap_angle(*heading_rad - pose.yaw_rad)) < kTurned_rad;
  const bool may_turn = stands(input.measured) && input.committed.at(input.now_s).at_rest;
  if (is_turned || (!may_turn && !errand_.turns_at)) {
    if (state_ == S::kWaiting) return;
    begin_errand(E::kNotItsTurn);
    keep_promise(input, output);  // an order begins where that ends
  } else if (!errand_.turns_at) {
    begin_errand(E::kTurn);
    errand_.turns_at = Goal{input.committed.end_pose().position, heading_rad};
  }
}

}  // namespace mocha
