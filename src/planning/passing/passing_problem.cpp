#include "planning/passing/passing_problem.h"

#include <stdexcept>
#include <string>

namespace mocha {

void validate(const PassingProblem& problem) {
  if (problem.starts.size() != problem.goals.size()) {
    throw std::invalid_argument("PassingProblem: " + std::to_string(problem.starts.size()) +
                                " starts, but " + std::to_string(problem.goals.size()) + " goals");
  }
  const auto check = [&](int place, int least) {
    if (place >= least && place < problem.graph.size()) return;
    throw std::invalid_argument("PassingProblem: there is no place " + std::to_string(place));
  };
  for (const int start : problem.starts) check(start, 0);
  for (const int goal : problem.goals) check(goal, PassingProblem::kAnywhere);
}

GoalDistances::GoalDistances(const PassingProblem& problem, double per_move_m) {
  for (const int goal : problem.goals) {
    distances_m_.push_back(goal == PassingProblem::kAnywhere
                               ? std::vector<double>()
                               : distances_to(problem.graph, goal, per_move_m));
  }
}

}  // namespace mocha
