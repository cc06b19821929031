#include "planning/passing/passing_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "planning/passing/step_search.h"

namespace mocha {
namespace {

/// A placing that was reached, and what is still to be tried from there.
struct VisitedPlacing {
  Placing placing;
  int parent;
  std::vector<int> waiting;        // of each robot: for how many steps it has not been at its goal
  std::vector<int> order;          // who chooses first
  std::queue<FixedMoves> demands;  // each: one step to be tried
};

class LazySearch {
 public:
  LazySearch(const PassingProblem& problem, const std::function<bool()>& should_stop)
      : problem_(problem),
        should_stop_(should_stop),
        distances_m_(problem),
        steps_(problem.graph, distances_m_) {}

  PassingSequence run(int most_steps) {
    if (!all_reach_their_goals()) return {PassingSequence::Outcome::kImpossible, {}};
    visit(problem_.starts, -1);
    for (int left = most_steps; !open_.empty() && left > 0 && !should_stop_(); --left) {
      const int node = open_.back();
      if (problem_.is_solved(nodes_[node].placing))
        return {PassingSequence::Outcome::kFound, sequence_to(node)};
      if (nodes_[node].demands.empty()) {
        open_.pop_back();
      } else {
        expand(node);
      }
    }
    return {
        open_.empty() ? PassingSequence::Outcome::kImpossible : PassingSequence::Outcome::kStopped,
        {}};
  }

 private:
  bool all_reach_their_goals() const {
    for (int robot = 0; robot < problem_.robots(); ++robot) {
      if (!std::isfinite(distances_m_(robot, problem_.starts[robot]))) return false;
    }
    return true;
  }

  /// A new node, on top of what is to be looked at.
  void visit(const Placing& placing, int parent) {
    VisitedPlacing node{placing, parent, {}, {}, {}};
    for (int robot = 0; robot < problem_.robots(); ++robot) {
      const int before = parent < 0 ? 0 : nodes_[parent].waiting[robot];
      node.waiting.push_back(problem_.is_at_goal(robot, placing[robot]) ? 0 : before + 1);
    }
    node.order.resize(problem_.robots());
    std::iota(node.order.begin(), node.order.end(), 0);
    const auto rank = [&](int robot) {
      return std::make_pair(-node.waiting[robot], -distances_m_(robot, placing[robot]));
    };
    std::stable_sort(node.order.begin(), node.order.end(),
                     [&](int a, int b) { return rank(a) < rank(b); });
    node.demands.push({});
    const int number = static_cast<int>(nodes_.size());
    numbers_[placing] = number;
    nodes_.push_back(std::move(node));
    open_.push_back(number);
  }

  void expand(int node) {
    const FixedMoves demand = nodes_[node].demands.front();
    nodes_[node].demands.pop();
    demand_more(node, demand);
    const std::optional<JointStep> step =
        steps_.step(nodes_[node].placing, nodes_[node].order, demand);
    if (!step) return;
    const auto known = numbers_.find(step->placing());
    if (known == numbers_.end()) {
      visit(step->placing(), node);
    } else if (known->second != node) {
      open_.push_back(known->second);
    }
  }

  /// The same demand with each choice of one more robot.
  void demand_more(int node, const FixedMoves& demand) {
    const std::size_t depth = demand.size();
    if (depth >= nodes_[node].order.size()) return;
    const int robot = nodes_[node].order[depth];
    for (const PlaceMove* move : steps_.choices(robot, nodes_[node].placing)) {
      FixedMoves more = demand;
      more.emplace_back(robot, move);
      nodes_[node].demands.push(std::move(more));
    }
  }

  std::vector<JointStep> sequence_to(int goal) const {
    std::vector<JointStep> sequence;
    for (int node = goal; nodes_[node].parent >= 0; node = nodes_[node].parent)
      sequence.push_back(step_between(nodes_[nodes_[node].parent].placing, nodes_[node].placing));
    std::reverse(sequence.begin(), sequence.end());
    return sequence;
  }

  JointStep step_between(const Placing& from, const Placing& to) const {
    JointStep step(problem_.graph, from);
    for (int robot = 0; robot < problem_.robots(); ++robot) {
      const auto& moves = problem_.graph.moves[from[robot]];
      const auto found = std::find_if(moves.begin(), moves.end(),
                                      [&](const PlaceMove& move) { return move.to == to[robot]; });
      step.choose(robot, found != moves.end() ? &*found : nullptr);
    }
    return step;
  }

  const PassingProblem& problem_;
  const std::function<bool()>& should_stop_;
  const GoalDistances distances_m_;
  StepSearch steps_;
  std::vector<VisitedPlacing> nodes_;
  std::map<Placing, int> numbers_;
  std::vector<int> open_;
};

}  // namespace

PassingSequence find_passing(const PassingProblem& problem, int most_steps,
                             const std::function<bool()>& should_stop) {
  validate(problem);
  return LazySearch(problem, should_stop).run(most_steps);
}

}  // namespace mocha
