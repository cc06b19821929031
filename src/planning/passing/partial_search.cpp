#include "planning/passing/partial_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace mocha {
namespace {

constexpr double kShareOfAll = 0.1;  // what all drive, against what the farthest drives
constexpr std::int16_t kStays = -1;
constexpr std::uint32_t kMostPlaces = 32768;

/// A number from 0 to 1, for each two numbers another.
double mixed(std::uint32_t a, std::uint32_t b) {
  std::uint32_t hash = a * 2654435761U ^ b * 2246822519U;
  hash = (hash ^ hash >> 15) * 2246822519U;
  hash = (hash ^ hash >> 13) * 3266489917U;
  return static_cast<double>(hash ^ hash >> 16) / 4294967296.0;
}

/// The places of those that are searched for, and the time as a number of steps.
using Placement = std::array<std::int16_t, PartialSearch::kMostTogether + 1>;

struct HashOfPlacement {
  std::size_t operator()(const Placement& placement) const {
    std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
    for (const std::int16_t part : placement)
      hash = (hash ^ static_cast<std::uint16_t>(part)) * 1099511628211ULL;
    return hash ^ hash >> 29;
  }
};

/// Where the robots are, and what the first of them have chosen to do next.
struct Node {
  Placement at;
  std::array<std::int16_t, PartialSearch::kMostTogether> moves;  // of each: which one
  std::int16_t chosen;
  int parent;         // in which the choice of this step began, and nothing is chosen
  double cost_m;      // of the steps before
  double farthest_m;  // in this one
  double all_m;
};

class Run {
 public:
  Run(const PassingProblem& problem, const GoalDistances& distances_m,
      const std::vector<JointStep>& sequence, const std::vector<int>& robots, std::uint32_t variant)
      : variant_(variant),
        problem_(problem),
        distances_m_(distances_m),
        sequence_(sequence),
        robots_(robots) {
    std::vector<bool> is_searched(problem.robots(), false);
    for (const int robot : robots) is_searched[robot] = true;
    for (int robot = 0; robot < problem.robots(); ++robot) {
      if (!is_searched[robot]) others_.push_back(robot);
    }
    for (std::size_t t = 0; t < sequence.size(); ++t) {
      for (const int other : others_) {
        if (sequence[t].move(other) != nullptr) others_rest_ = static_cast<int>(t) + 1;
      }
    }
    others_left_m_.assign(others_rest_ + 1, 0.0);
    for (int t = others_rest_ - 1; t >= 0; --t)
      others_left_m_[t] = others_left_m_[t + 1] + others_farthest_m(sequence[t]);
  }

  PassingSequence run(int& left, const std::function<bool()>& should_stop) {
    Node first{};
    for (int i = 0; i < count(); ++i) first.at[i] = problem_.starts[robots_[i]];
    add(first);
    while (!queue_.empty()) {
      const int number = std::get<2>(queue_.top());
      queue_.pop();
      const Node node = nodes_[number];
      if (node.chosen == 0 && best_m_.at(node.at) < node.cost_m) continue;
      if (node.chosen == 0 && is_solved(node)) return {Outcome::kFound, steps_to(number)};
      if (--left < 0 || should_stop()) return {Outcome::kStopped, {}};
      expand(node.chosen == 0 ? number : node.parent, node);
    }
    return {Outcome::kImpossible, {}};
  }

 private:
  using Outcome = PassingSequence::Outcome;
  using Entry = std::tuple<double, int, int>;  // costs at least; newest first; the node

  int count() const { return static_cast<int>(robots_.size()); }
  int time(const Node& node) const { return node.at.back(); }

  bool is_solved(const Node& node) const {
    if (time(node) < others_rest_) return false;
    for (int i = 0; i < count(); ++i) {
      if (!problem_.is_at_goal(robots_[i], node.at[i])) return false;
    }
    return true;
  }

  const PlaceMove* move_of(const Node& node, int i) const {
    return node.moves[i] == kStays ? nullptr : &problem_.graph.moves[node.at[i]][node.moves[i]];
  }

  int place_after(const Node& node, int i) const {
    const PlaceMove* move = i < node.chosen ? move_of(node, i) : nullptr;
    return move != nullptr ? move->to : node.at[i];
  }

  double cost_m(int from, const PlaceMove& move) const {
    const double longer = variant_ == 0 ? 0.0 : mixed(from * kMostPlaces + move.to, variant_);
    return (1.0 + longer) * (move.length_m + kPerMove_m);
  }

  /// What a step costs at least, by those that are not searched for.
  double others_farthest_m(const JointStep& step) const {
    double farthest_m = 0.0;
    for (const int other : others_) {
      if (step.move(other) != nullptr)
        farthest_m = std::max(farthest_m, cost_m(step.from(other), *step.move(other)));
    }
    return farthest_m;
  }

  void add(const Node& node) {
    double farthest_m = std::max(node.farthest_m, others_left_m_[time(node)]);
    double all_m = node.all_m;
    for (int i = 0; i < count(); ++i) {
      const double left_m = distances_m_(robots_[i], place_after(node, i));
      // Robots that have not chosen yet drive while the others do.
      farthest_m = std::max(farthest_m, i < node.chosen ? node.farthest_m + left_m : left_m);
      all_m += left_m;
    }
    if (!std::isfinite(farthest_m)) return;
    if (node.chosen == 0) {
      const auto [known, is_new] = best_m_.emplace(node.at, node.cost_m);
      if (!is_new && known->second <= node.cost_m) return;
      known->second = node.cost_m;
    }
    const int number = static_cast<int>(nodes_.size());
    const double least_m = node.cost_m + farthest_m + kShareOfAll * all_m;
    queue_.emplace(least_m, -number, number);
    nodes_.push_back(node);
  }

  /// Before anybody of those that are searched for has chosen.
  JointStep step_from(const Node& node) const {
    const bool others_go_on = time(node) < static_cast<int>(sequence_.size());
    Placing placing = problem_.starts;
    for (const int other : others_) {
      if (!sequence_.empty())
        placing[other] =
            others_go_on ? sequence_[time(node)].from(other) : sequence_.back().to(other);
    }
    for (int i = 0; i < count(); ++i) placing[robots_[i]] = node.at[i];
    JointStep step(problem_.graph, placing);
    for (const int other : others_)
      step.choose(other, others_go_on ? sequence_[time(node)].move(other) : nullptr);
    return step;
  }

  JointStep step_of(const Node& node) const {
    JointStep step = step_from(node);
    for (int i = 0; i < node.chosen; ++i) step.choose(robots_[i], move_of(node, i));
    return step;
  }

  void expand(int parent, const Node& node) {
    const JointStep before = step_of(node);
    const int i = node.chosen;
    const auto& moves = problem_.graph.moves[node.at[i]];
    for (std::int16_t move = kStays; move < static_cast<std::int16_t>(moves.size()); ++move) {
      JointStep step = before;
      if (!step.choose(robots_[i], move == kStays ? nullptr : &moves[move])) continue;
      Node next = node;
      next.moves[i] = move;
      next.chosen = static_cast<std::int16_t>(i + 1);
      next.parent = parent;
      if (move != kStays) {
        next.farthest_m = std::max(next.farthest_m, cost_m(node.at[i], moves[move]));
        next.all_m += cost_m(node.at[i], moves[move]);
      }
      add(next.chosen < count() ? next : after(next, step));
    }
  }

  /// Where all are after a step that all have chosen.
  Node after(const Node& node, const JointStep& step) const {
    const double farthest_m = std::max(node.farthest_m, others_farthest_m(step));
    Node next = node;
    for (int i = 0; i < count(); ++i) next.at[i] = static_cast<std::int16_t>(place_after(node, i));
    next.at.back() = static_cast<std::int16_t>(std::min(time(node) + 1, others_rest_));
    next.chosen = 0;
    next.cost_m += farthest_m + kShareOfAll * node.all_m;
    next.farthest_m = 0.0;
    next.all_m = 0.0;
    return next;
  }

  std::vector<JointStep> steps_to(int number) const {
    std::vector<JointStep> steps;
    for (int node = number; node > 0; node = nodes_[node].parent) {
      Node before = nodes_[nodes_[node].parent];
      before.moves = nodes_[node].moves;
      before.chosen = static_cast<std::int16_t>(count());
      steps.push_back(step_of(before));
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

  const std::uint32_t variant_;
  const PassingProblem& problem_;
  const GoalDistances& distances_m_;
  const std::vector<JointStep>& sequence_;
  const std::vector<int>& robots_;
  std::vector<int> others_;
  int others_rest_ = 0;                // after so many steps
  std::vector<double> others_left_m_;  // what the steps from each on cost at least
  std::vector<Node> nodes_;
  std::unordered_map<Placement, double, HashOfPlacement> best_m_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

PartialSearch::PartialSearch(const PassingProblem& problem)
    : problem_(problem), distances_m_(problem, kPerMove_m) {}

PassingSequence PartialSearch::run(const std::vector<JointStep>& steps,
                                   const std::vector<int>& robots, std::uint32_t variant, int& left,
                                   const std::function<bool()>& should_stop) const {
  return Run(problem_, distances_m_, steps, robots, variant).run(left, should_stop);
}

}  // namespace mocha
