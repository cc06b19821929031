#include "planning/passing/passing_order.h"

#include <algorithm>

namespace mocha {
namespace {

struct Made {
  const PlaceMove* move;
  int from;
};

bool holds(const std::vector<int>& sorted, int place) {
  return std::binary_search(sorted.begin(), sorted.end(), place);
}

/// Whether the later move is only possible, or leaves the earlier one possible, after it.
bool has_to_follow(const Made& later, const Made& earlier) {
  return holds(later.move->blocked_by, earlier.from) ||
         holds(earlier.move->blocked_by, later.move->to);
}

}  // namespace

PassingOrder order_of(const std::vector<JointStep>& steps, int robots) {
  PassingOrder order(robots);
  std::vector<std::vector<Made>> made(robots);
  for (const JointStep& step : steps) {
    for (const int robot : step.order()) {
      const Made next{step.move(robot), step.from(robot)};
      PassingTurn turn{next.move->path, {}};
      for (int other = 0; other < robots; ++other) {
        int moves = other == robot ? 0 : static_cast<int>(made[other].size());
        while (moves > 0 && !has_to_follow(next, made[other][moves - 1])) --moves;
        if (moves == 0) continue;
        turn.after.push_back(
            {static_cast<std::uint32_t>(other), static_cast<std::uint32_t>(moves)});
      }
      made[robot].push_back(next);
      order[robot].push_back(std::move(turn));
    }
  }
  return order;
}

}  // namespace mocha
