#pragma once

#include <vector>

#include "planning/passing/joint_step.h"

namespace mocha {

/// The place of each robot now, and the one that it is to get to.
struct PassingProblem {
  static constexpr int kAnywhere = -1;

  PlaceGraph graph;
  Placing starts;
  Placing goals;  ///< kAnywhere: the robot has no goal, and makes room as it likes

  int robots() const { return static_cast<int>(starts.size()); }
  bool is_at_goal(int robot, int place) const {
    return goals[robot] == kAnywhere || goals[robot] == place;
  }
  bool is_solved(const Placing& placing) const {
    for (int robot = 0; robot < robots(); ++robot) {
      if (!is_at_goal(robot, placing[robot])) return false;
    }
    return true;
  }
};

/// What it costs to begin and to end a move, as a distance [m].
constexpr double kPerMove_m = 1.0;

/// Throws std::invalid_argument where starts and goals are not of as many robots, or not of the
/// graph.
void validate(const PassingProblem& problem);

/// How far it is for each robot to its goal from each place, other robots aside [m], where each
/// move counts as so much longer.
class GoalDistances {
 public:
  explicit GoalDistances(const PassingProblem& problem, double per_move_m = 0.0);
  /// Infinite where there is no way; 0 for a robot without a goal.
  double operator()(int robot, int place) const {
    return distances_m_[robot].empty() ? 0.0 : distances_m_[robot][place];
  }

 private:
  std::vector<std::vector<double>> distances_m_;  // empty for a robot without a goal
};

/// Steps from the starts to the goals, or why there are none.
struct PassingSequence {
  enum class Outcome {
    kFound,
    kImpossible,  ///< whatever the robots do: all that they can do was looked at
    kStopped,     ///< the effort, or the caller, ended it
  };
  Outcome outcome = Outcome::kStopped;
  std::vector<JointStep> steps;  ///< their graph is the problem's
};

}  // namespace mocha
