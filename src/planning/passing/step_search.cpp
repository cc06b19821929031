#include "planning/passing/step_search.h"

#include <algorithm>
#include <tuple>

namespace mocha {
namespace {

constexpr int kMostTries = 400;  // of one step; robots that push each other about in vain

}  // namespace

std::optional<JointStep> StepSearch::step(const Placing& from, const std::vector<int>& order,
                                          const FixedMoves& fixed) {
  JointStep step(graph_, from);
  tried_ = 0;
  for (const auto& [robot, move] : fixed) {
    if (!step.choose(robot, move)) return std::nullopt;
  }
  for (const int robot : order) {
    if (!step.is_chosen(robot) && !choose(robot, step)) return std::nullopt;
  }
  return step;
}

std::vector<const PlaceMove*> StepSearch::choices(int robot, const Placing& from) const {
  const int here = from[robot];
  std::vector<const PlaceMove*> choices = {nullptr};
  for (const PlaceMove& move : graph_.moves[here]) choices.push_back(&move);
  const auto rank = [&](const PlaceMove* move) {
    const int there = move != nullptr ? move->to : here;
    const bool taken = move != nullptr && std::count(from.begin(), from.end(), there) > 0;
    return std::make_tuple(distances_m_(robot, there), taken, move != nullptr, there);
  };
  std::sort(choices.begin(), choices.end(),
            [&](const PlaceMove* a, const PlaceMove* b) { return rank(a) < rank(b); });
  return choices;
}

/// Whoever stands in the way chooses next; if one of them cannot, the robot chooses something else.
bool StepSearch::choose(int robot, JointStep& step) {
  Placing from(step.robots());
  for (int i = 0; i < step.robots(); ++i) from[i] = step.from(i);
  for (const PlaceMove* move : choices(robot, from)) {
    if (++tried_ > kMostTries) return false;
    const JointStep before = step;
    if (!step.choose(robot, move)) continue;
    bool possible = true;
    if (move != nullptr) {
      for (const int other : step.in_the_way(robot, *move))
        possible = possible && (step.is_chosen(other) || choose(other, step));
    }
    if (possible) return true;
    step = before;
  }
  return false;
}

}  // namespace mocha
