#pragma once

#include <deque>
#include <optional>
#include <string>

#include "config/parameter_table.h"
#include "control/robot_state.h"
#include "world/goal.h"

namespace mocha {

struct GoalOptions {
  double tolerance_m;
  double yaw_tolerance_rad;
  double timeout_s;        ///< without progress
  double search_radius_m;  ///< of an occupied goal; a place within it counts for the goal

  /// Of config/global_planner.yaml.
  static GoalOptions from(const ParameterTable& values);
};

/// Goals to be visited in order: which one counts now, whether it is reached, whether anything
/// still moves on.
class GoalQueue {
 public:
  enum class Event { kNone, kReached, kAllReached, kTimedOut };

  explicit GoalQueue(const GoalOptions& options) : options_(options) {}
  /// For the goals that are there and those to come.
  void set_options(const GoalOptions& options) { options_ = options; }

  /// Which of the goals counts now, from 1, and in which lap of a patrol; 0 without any.
  struct Progress {
    int goal = 0;
    int goals = 0;
    int lap = 0;  ///< 0: it is no patrol

    /// "waypoint 2 of 4, lap 1"; empty for a goal that is the only one.
    std::string words() const;
    bool operator==(const Progress& other) const {
      return goal == other.goal && goals == other.goals && lap == other.lap;
    }
  };

  /// Replaces all goals. In a patrol, the first follows the last, without end.
  void set(std::deque<Goal> goals, double now_s, bool patrols = false);
  void clear() { goals_.clear(); }
  bool empty() const { return goals_.empty(); }
  /// The goal that counts now, as it was given; the queue must not be empty.
  const Goal& asked() const { return goals_.front(); }
  /// Where that is to be reached for now: there, or near by while it is occupied.
  Goal current() const;
  /// The goal turned out to be occupied, or free again: this place near by, or itself, counts.
  void move_current(const Vector2& position) { instead_ = position; }
  /// The robot makes room for others: that is no lack of progress.
  void wait(double now_s) { progress_s_ = now_s; }
  /// Without progress for too long.
  bool overdue(double now_s) const { return now_s - progress_s_ > options_.timeout_s; }
  /// Those that are still to be visited, in order.
  const std::deque<Goal>& left() const { return goals_; }
  Progress progress() const { return goals_.empty() ? Progress{} : progress_; }

  /// Arrival is standing within the tolerances, at the goal or at a place that counts for it; then
  /// the next goal counts. Progress is coming nearer to the goal than ever, or being half a metre
  /// away from where the last progress was. After kAllReached and kTimedOut the queue is empty.
  Event update(double now_s, const RobotState& state);

 private:
  void note_progress(double now_s, const Vector2& position);
  void begin(double now_s);
  void pass_on();

  GoalOptions options_;
  std::deque<Goal> goals_;
  Progress progress_;
  std::optional<Vector2> instead_;
  double nearest_m_ = 0.0;
  std::optional<Vector2> progress_at_;
  double progress_s_ = 0.0;
};

}  // namespace mocha
