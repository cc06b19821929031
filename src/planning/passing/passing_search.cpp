#include "planning/passing/passing_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

#include "planning/passing/step_search.h"

namespace mocha {
namespace {

constexpr double kShareOfAll = 0.1;  // what all drive, against what the farthest drives
constexpr int kStepsToImprove = 500;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

/// A placing that was reached, and what is still to be tried from there.
struct Node {
  Placing placing;
  int parent;
  double cost_m;                   // from the starts
  double bound_m;                  // at least, to the goals
  std::vector<double> waiting;     // of each robot: for how many steps it has not been at its goal
  std::vector<int> order;          // who chooses first
  std::queue<FixedMoves> demands;  // each: one step to be tried
  std::map<int, double> next;      // nodes that one step leads to, and what it costs
};

std::vector<std::vector<double>> distances(const PassingProblem& problem) {
  std::vector<std::vector<double>> distances_m;
  for (const int goal : problem.goals) {
    distances_m.push_back(goal == PassingProblem::kAnywhere ? std::vector<double>()
                                                            : distances_to(problem.graph, goal));
  }
  return distances_m;
}

class Search {
 public:
  Search(const PassingProblem& problem, std::vector<std::vector<double>> distances_m,
         std::uint32_t variant, const std::function<bool()>& should_stop)
      : problem_(problem),
        should_stop_(should_stop),
        variant_(variant),
        distances_m_(std::move(distances_m)),
        steps_(problem.graph, distances_m_, variant) {}

  /// Counts down `left`, the steps that may be looked at, and some more once there is a solution.
  PassingSequence run(int& left) {
    visit(problem_.starts, -1, 0.0);
    if (nodes_[0].bound_m == kInfinity) return {PassingSequence::Outcome::kImpossible, {}};
    int more = kStepsToImprove;
    while (!open_.empty() && left > 0 && more > 0 && !should_stop_()) {
      const int node = open_.back();
      if (is_at_goals(node)) goal_ = node;
      if (nodes_[node].demands.empty() || !may_improve(node)) {
        open_.pop_back();
        continue;
      }
      --left;
      if (goal_ >= 0) --more;
      expand(node);
    }
    if (goal_ >= 0) return {PassingSequence::Outcome::kFound, sequence()};
    return {
        open_.empty() ? PassingSequence::Outcome::kImpossible : PassingSequence::Outcome::kStopped,
        {}};
  }

 private:
  int robots() const { return static_cast<int>(problem_.starts.size()); }

  /// Who chooses first where all wait for as long; none in the first variant.
  double head_start(int robot) const {
    return variant_ == 0 ? 0.0 : std::fmod(0.618 * (robot + 1) * variant_, 1.0);
  }

  bool is_at_goal(int robot, int place) const {
    const int goal = problem_.goals[robot];
    return goal == PassingProblem::kAnywhere || goal == place;
  }

  bool is_at_goals(int node) const {
    for (int robot = 0; robot < robots(); ++robot) {
      if (!is_at_goal(robot, nodes_[node].placing[robot])) return false;
    }
    return true;
  }

  bool may_improve(int node) const {
    return goal_ < 0 || nodes_[node].cost_m + nodes_[node].bound_m < nodes_[goal_].cost_m;
  }

  double bound_m(const Placing& placing) const {
    double farthest_m = 0.0;
    double all_m = 0.0;
    for (int robot = 0; robot < robots(); ++robot) {
      const double left_m = steps_.to_goal_m(robot, placing[robot]);
      farthest_m = std::max(farthest_m, left_m);
      all_m += left_m;
    }
    return farthest_m + kShareOfAll * all_m;
  }

  /// A new node, on top of what is to be looked at.
  int visit(const Placing& placing, int parent, double cost_m) {
    Node node{placing, parent, cost_m, bound_m(placing), {}, {}, {}, {}};
    for (int robot = 0; robot < robots(); ++robot) {
      const double before = parent < 0 ? head_start(robot) : nodes_[parent].waiting[robot];
      node.waiting.push_back(is_at_goal(robot, placing[robot]) ? 0.0 : before + 1.0);
    }
    node.order.resize(robots());
    std::iota(node.order.begin(), node.order.end(), 0);
    std::stable_sort(node.order.begin(), node.order.end(), [&](int a, int b) {
      const double far_m = steps_.to_goal_m(a, placing[a]);
      const double other_m = steps_.to_goal_m(b, placing[b]);
      return std::make_pair(-node.waiting[a], -far_m) < std::make_pair(-node.waiting[b], -other_m);
    });
    node.demands.push({});
    const int number = static_cast<int>(nodes_.size());
    numbers_[placing] = number;
    nodes_.push_back(std::move(node));
    open_.push_back(number);
    return number;
  }

  void expand(int node) {
    const FixedMoves demand = nodes_[node].demands.front();
    nodes_[node].demands.pop();
    demand_more(node, demand);
    const std::optional<JointStep> step =
        steps_.step(nodes_[node].placing, nodes_[node].order, demand);
    if (!step || step->placing() == nodes_[node].placing) return;
    const double cost_m = cost_of(*step);
    const auto known = numbers_.find(step->placing());
    if (known == numbers_.end()) {
      const int next = visit(step->placing(), node, nodes_[node].cost_m + cost_m);
      nodes_[node].next[next] = cost_m;
      return;
    }
    const int next = known->second;
    const auto [entry, is_new] = nodes_[node].next.emplace(next, cost_m);
    if (!is_new) entry->second = std::min(entry->second, cost_m);
    rewire(node);
    if (may_improve(next)) open_.push_back(next);
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

  double cost_of(const JointStep& step) const {
    double farthest_m = 0.0;
    double all_m = 0.0;
    for (int robot = 0; robot < robots(); ++robot) {
      if (step.move(robot) == nullptr) continue;
      farthest_m = std::max(farthest_m, step.move(robot)->length_m);
      all_m += step.move(robot)->length_m;
    }
    return farthest_m + kShareOfAll * all_m;
  }

  /// Passes on what has become cheaper from a node on.
  void rewire(int from) {
    std::queue<int> cheaper;
    cheaper.push(from);
    while (!cheaper.empty()) {
      const int node = cheaper.front();
      cheaper.pop();
      for (const auto& [next, step_m] : nodes_[node].next) {
        const double cost_m = nodes_[node].cost_m + step_m;
        if (!(cost_m < nodes_[next].cost_m)) continue;
        nodes_[next].cost_m = cost_m;
        nodes_[next].parent = node;
        cheaper.push(next);
        if (may_improve(next) && goal_ >= 0) open_.push_back(next);
      }
    }
  }

  std::vector<JointStep> sequence() const {
    std::vector<int> path;
    for (int node = goal_; node >= 0; node = nodes_[node].parent) path.push_back(node);
    std::reverse(path.begin(), path.end());
    std::vector<JointStep> sequence;
    for (std::size_t i = 1; i < path.size(); ++i)
      sequence.push_back(step_between(nodes_[path[i - 1]].placing, nodes_[path[i]].placing));
    return sequence;
  }

  JointStep step_between(const Placing& from, const Placing& to) const {
    JointStep step(problem_.graph, from);
    for (int robot = 0; robot < robots(); ++robot) {
      const auto& moves = problem_.graph.moves[from[robot]];
      const auto found = std::find_if(moves.begin(), moves.end(),
                                      [&](const PlaceMove& move) { return move.to == to[robot]; });
      step.choose(robot, found != moves.end() ? &*found : nullptr);
    }
    return step;
  }

  const PassingProblem& problem_;
  const std::function<bool()>& should_stop_;
  const std::uint32_t variant_;
  const std::vector<std::vector<double>> distances_m_;
  StepSearch steps_;
  std::vector<Node> nodes_;
  std::map<Placing, int> numbers_;
  std::vector<int> open_;
  int goal_ = -1;
};

}  // namespace

PassingSequence find_passing(const PassingProblem& problem, std::uint32_t variant, int& left,
                             const std::function<bool()>& should_stop) {
  validate(problem);
  return Search(problem, distances(problem), variant, should_stop).run(left);
}

}  // namespace mocha
