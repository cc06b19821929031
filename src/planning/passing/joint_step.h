#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planning/passing/place_graph.h"

namespace mocha {

/// The place of each robot, by number.
using Placing = std::vector<int>;

/// Moves of several robots to neighbouring places, so that an order exists in which they can go one
/// after the other: each while all others stand at places that do not block its way.
class JointStep {
 public:
  static constexpr int kMostRobots = 32;

  /// Nobody's move is chosen yet. Throws std::invalid_argument for more than kMostRobots.
  JointStep(const PlaceGraph& graph, const Placing& from);

  /// Chooses what a robot does; without a move, it stays. False, and nothing is chosen, where no
  /// order with the moves chosen before exists.
  bool choose(int robot, const PlaceMove* move);
  bool is_chosen(int robot) const { return chosen_ >> robot & 1U; }

  int robots() const { return robots_; }
  int from(int robot) const { return from_[robot]; }
  /// The move chosen for a robot; null where it stays.
  const PlaceMove* move(int robot) const { return moves_[robot]; }
  /// Where a robot is after its move; where it is now while none is chosen.
  int to(int robot) const { return to_[robot]; }
  Placing placing() const { return {to_.begin(), to_.begin() + robots_}; }
  /// Robots that stand in the way of a move, other than `robot`.
  std::vector<int> in_the_way(int robot, const PlaceMove& move) const;
  /// The robots that move, in a possible order.
  std::vector<int> order() const;

  const PlaceGraph& graph() const { return *graph_; }

 private:
  using Robots = std::uint32_t;  // a set, one bit each

  bool may_precede(int first, int second) const;
  bool leads_back(int robot) const;

  const PlaceGraph* graph_;
  // Steps are copied by the million.
  int robots_;
  std::array<int, kMostRobots> from_;
  std::array<int, kMostRobots> to_;
  std::array<const PlaceMove*, kMostRobots> moves_{};
  std::array<Robots, kMostRobots> before_{};  // of each: who has to go after it
  Robots chosen_ = 0;
};

}  // namespace mocha
