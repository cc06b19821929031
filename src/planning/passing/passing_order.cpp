#include "planning/passing/passing_order.h"

#include <algorithm>

namespace mocha {
namespace {

struct Made {
  const PlaceMove* move;
  int from;
};

/// Whether the later move is only possible, or leaves the earlier one possible, after it.
bool has_to_follow(const Made& later, const Made& earlier) {
  return later.move->blocked_by.contains(earlier.from) ||
         earlier.move->blocked_by.contains(later.move->to);
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

std::vector<std::uint32_t> alone_from(const PassingOrder& order) {
  std::vector<std::uint32_t> from(order.size(), 0);
  for (std::size_t robot = 0; robot < order.size(); ++robot) {
    for (std::uint32_t move = 0; move < order[robot].size(); ++move) {
      const auto& after = order[robot][move].after;
      if (!after.empty()) from[robot] = std::max(from[robot], move + 1);
      for (const PassingProgress& progress : after)
        from[progress.robot] = std::max(from[progress.robot], progress.moves);
    }
  }
  return from;
}

}  // namespace mocha
