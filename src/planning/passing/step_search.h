#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "planning/passing/joint_step.h"

namespace mocha {

/// What some robots have to do, whatever they would like; without a move, they stay.
using FixedMoves = std::vector<std::pair<int, const PlaceMove*>>;

/// A joint step in which each robot comes as near to its goal as those before it allow, and whoever
/// stands in the way of a robot makes room in its name: priority inheritance with backtracking
/// (Okumura et al., PIBT, Artificial Intelligence 310, 2022), by ways that block each other.
class StepSearch {
 public:
  /// `distances_m`: of each robot to its goal from each place; empty for one that may be anywhere.
  /// `variant`: of what is as good as another. All must outlive this.
  StepSearch(const PlaceGraph& graph, const std::vector<std::vector<double>>& distances_m,
             std::uint32_t variant)
      : graph_(graph), distances_m_(distances_m), variant_(variant) {}

  /// The robots choose in this order. Nothing where it finds no step: there may be one with other
  /// fixed moves.
  std::optional<JointStep> step(const Placing& from, const std::vector<int>& order,
                                const FixedMoves& fixed);

  /// What a robot at a place can do, best first.
  std::vector<const PlaceMove*> choices(int robot, const Placing& from) const;
  /// Along the graph, other robots aside [m].
  double to_goal_m(int robot, int place) const {
    return distances_m_[robot].empty() ? 0.0 : distances_m_[robot][place];
  }

 private:
  bool choose(int robot, JointStep& step);

  const PlaceGraph& graph_;
  const std::vector<std::vector<double>>& distances_m_;
  const std::uint32_t variant_;
  int tried_ = 0;
};

}  // namespace mocha
