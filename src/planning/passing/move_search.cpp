#include "planning/passing/move_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace mocha {
namespace {

struct MovedPlacing {
  Placing placing;
  int parent;
  int robot;              // that has moved
  const PlaceMove* move;  // and how
  double cost_m;
};

class CheapestMoves {
 public:
  CheapestMoves(const PassingProblem& problem, const MoveSearchOptions& options)
      : problem_(problem), options_(options), distances_m_(problem, kPerMove_m) {}

  PassingSequence run(const std::function<bool()>& should_stop) {
    add({problem_.starts, -1, -1, nullptr, 0.0});
    while (!queue_.empty()) {
      const auto [rank_m, unused, number] = queue_.top();
      queue_.pop();
      if (best_m_.at(nodes_[number].placing) < nodes_[number].cost_m) continue;
      if (problem_.is_solved(nodes_[number].placing)) return {Outcome::kFound, steps_to(number)};
      if (static_cast<int>(nodes_.size()) > options_.most_placings || should_stop())
        return {Outcome::kStopped, {}};
      for (int robot = 0; robot < problem_.robots(); ++robot) {
        for (const PlaceMove& move : problem_.graph.moves[nodes_[number].placing[robot]]) {
          if (is_free(nodes_[number].placing, robot, move)) make(number, robot, move);
        }
      }
    }
    return {Outcome::kImpossible, {}};
  }

 private:
  using Outcome = PassingSequence::Outcome;
  using Entry = std::tuple<double, int, int>;  // its rank; newest first; the node

  static bool is_free(const Placing& placing, int robot, const PlaceMove& move) {
    for (int other = 0; other < static_cast<int>(placing.size()); ++other) {
      if (other != robot && move.blocked_by.contains(placing[other])) return false;
    }
    return true;
  }

  void make(int from, int robot, const PlaceMove& move) {
    MovedPlacing next{nodes_[from].placing, from, robot, &move,
                      nodes_[from].cost_m + move.length_m + kPerMove_m};
    next.placing[robot] = move.to;
    add(std::move(next));
  }

  void add(MovedPlacing node) {
    double left_m = 0.0;
    for (int robot = 0; robot < problem_.robots(); ++robot)
      left_m += distances_m_(robot, node.placing[robot]);
    if (!std::isfinite(left_m)) return;
    const auto [known, is_new] = best_m_.emplace(node.placing, node.cost_m);
    if (!is_new && known->second <= node.cost_m) return;
    known->second = node.cost_m;
    const int number = static_cast<int>(nodes_.size());
    queue_.emplace(node.cost_m + options_.times_least * left_m, -number, number);
    nodes_.push_back(std::move(node));
  }

  std::vector<JointStep> steps_to(int goal) const {
    std::vector<JointStep> steps;
    for (int node = goal; nodes_[node].parent >= 0; node = nodes_[node].parent) {
      JointStep step(problem_.graph, nodes_[nodes_[node].parent].placing);
      for (int robot = 0; robot < problem_.robots(); ++robot)
        step.choose(robot, robot == nodes_[node].robot ? nodes_[node].move : nullptr);
      steps.push_back(step);
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

  const PassingProblem& problem_;
  const MoveSearchOptions options_;
  const GoalDistances distances_m_;
  std::vector<MovedPlacing> nodes_;
  std::map<Placing, double> best_m_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

PassingSequence find_few_moves(const PassingProblem& problem, const MoveSearchOptions& options,
                               const std::function<bool()>& should_stop) {
  validate(problem);
  if (!(options.times_least >= 1.0)) {
    throw std::invalid_argument("find_few_moves: times_least " +
                                std::to_string(options.times_least) + ", allowed is 1 or above");
  }
  return CheapestMoves(problem, options).run(should_stop);
}

}  // namespace mocha
