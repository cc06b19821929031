#pragma once

#include <vector>

#include "planning/passing/passing_search.h"

namespace mocha {

/// So many of its moves a robot has to have made.
struct Progress {
  int robot;
  int moves;
};

/// One move of a robot.
struct PassingTurn {
  std::vector<Vector2> path;    ///< from place to place, straight between; map frame [m]
  std::vector<Progress> after;  ///< of others, at most one each; before it must not begin
};

/// The moves of each robot, and which of them have to wait for which of others. Whoever keeps to it
/// needs no common time: in whatever order the moves are made one by one, each finds its way free,
/// and there is always a next one until all are at their goals.
using PassingOrder = std::vector<std::vector<PassingTurn>>;

PassingOrder order_of(const PassingSequence& sequence, int robots);

}  // namespace mocha
