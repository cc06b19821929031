#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "planning/passing/passing_problem.h"

namespace mocha {

/// What some robots have to do, whatever they would like; without a move, they stay.
using FixedMoves = std::vector<std::pair<int, const PlaceMove*>>;

/// A joint step in which each robot comes as near to its goal as those before it allow, and whoever
/// stands in the way of a robot makes room in its name: priority inheritance with backtracking
/// (Okumura et al., PIBT, Artificial Intelligence 310, 2022), by ways that block each other.
class StepSearch {
 public:
  /// Both must outlive this.
  StepSearch(const PlaceGraph& graph, const GoalDistances& distances_m)
      : graph_(graph), distances_m_(distances_m) {}

  /// The robots choose in this order. Nothing where it finds no step: there may be one with other
  /// fixed moves.
  std::optional<JointStep> step(const Placing& from, const std::vector<int>& order,
                                const FixedMoves& fixed);

  /// What a robot at a place can do, best first.
  std::vector<const PlaceMove*> choices(int robot, const Placing& from) const;

 private:
  bool choose(int robot, JointStep& step);

  const PlaceGraph& graph_;
  const GoalDistances& distances_m_;
  int tried_ = 0;
};

}  // namespace mocha
