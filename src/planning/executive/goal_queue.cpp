#include "planning/executive/goal_queue.h"

#include <cmath>
#include <limits>
#include <utility>

namespace mocha {
namespace {

constexpr double kNearer_m = 0.1;
constexpr double kElsewhere_m = 0.5;
constexpr double kRounding_m = 1e-6;  // of a place that was searched

}  // namespace

GoalOptions GoalOptions::from(const ParameterTable& values) {
  return {values.number("goal_tolerance"), values.number("goal_yaw_tolerance"),
          values.number("goal_timeout"), values.number("goal_search_radius")};
}

std::string GoalQueue::Progress::words() const {
  if (goals < 2) return "";
  std::string text = "waypoint " + std::to_string(goal) + " of " + std::to_string(goals);
  return lap == 0 ? text : text + ", lap " + std::to_string(lap);
}

void GoalQueue::set(std::deque<Goal> goals, double now_s, bool patrols) {
  goals_ = std::move(goals);
  progress_ = {1, static_cast<int>(goals_.size()), patrols ? 1 : 0};
  begin(now_s);
}

Goal GoalQueue::current() const {
  Goal goal = goals_.front();
  if (instead_) goal.position = *instead_;
  return goal;
}

void GoalQueue::begin(double now_s) {
  instead_.reset();
  nearest_m_ = std::numeric_limits<double>::infinity();
  progress_at_.reset();
  progress_s_ = now_s;
}

/// The next goal counts.
void GoalQueue::pass_on() {
  if (progress_.lap > 0) goals_.push_back(goals_.front());
  goals_.pop_front();
  if (progress_.lap > 0 && progress_.goal == progress_.goals) ++progress_.lap;
  progress_.goal = progress_.goal % progress_.goals + 1;
}

void GoalQueue::note_progress(double now_s, const Vector2& position) {
  const double distance_m = (position - current().position).norm();
  const bool nearer = distance_m < nearest_m_ - kNearer_m;
  const bool elsewhere = !progress_at_ || (position - *progress_at_).norm() > kElsewhere_m;
  if (nearer) nearest_m_ = distance_m;
  if (!nearer && !elsewhere) return;
  progress_at_ = position;
  progress_s_ = now_s;
}

GoalQueue::Event GoalQueue::update(double now_s, const RobotState& state) {
  if (goals_.empty()) return Event::kNone;
  note_progress(now_s, state.pose.position);
  const Goal goal = current();
  const bool counts =
      (goal.position - asked().position).norm() <= options_.search_radius_m + kRounding_m;
  const bool there = (state.pose.position - goal.position).norm() <= options_.tolerance_m;
  const bool aligned = !goal.yaw_rad || std::abs(wrap_angle(*goal.yaw_rad - state.pose.yaw_rad)) <=
                                            options_.yaw_tolerance_rad;
  if (counts && there && aligned && stands(state)) {
    pass_on();
    begin(now_s);
    return goals_.empty() ? Event::kAllReached : Event::kReached;
  }
  if (overdue(now_s)) {
    goals_.clear();
    return Event::kTimedOut;
  }
  return Event::kNone;
}

}  // namespace mocha
