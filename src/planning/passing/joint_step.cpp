#include "planning/passing/joint_step.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

bool blocks(const PlaceMove* move, int place) {
  return move != nullptr && move->blocked_by.contains(place);
}

}  // namespace

JointStep::JointStep(const PlaceGraph& graph, const Placing& from)
    : graph_(&graph), robots_(static_cast<int>(from.size())) {
  if (robots() > kMostRobots) {
    throw std::invalid_argument("JointStep: " + std::to_string(robots()) + " robots, allowed are " +
                                std::to_string(kMostRobots));
  }
  std::copy(from.begin(), from.end(), from_.begin());
  std::copy(from.begin(), from.end(), to_.begin());
}

/// The first goes while the second is where it was; then that goes, past where the first is.
bool JointStep::may_precede(int first, int second) const {
  return !blocks(moves_[first], from_[second]) && !blocks(moves_[second], to_[first]);
}

bool JointStep::choose(int robot, const PlaceMove* move) {
  const auto before = before_;
  moves_[robot] = move;
  to_[robot] = move != nullptr ? move->to : from_[robot];
  bool possible = true;
  for (int other = 0; other < robots() && possible; ++other) {
    if (other == robot || !is_chosen(other)) continue;
    const bool first = may_precede(robot, other);
    const bool last = may_precede(other, robot);
    possible = first || last;
    if (!last) before_[robot] |= Robots{1} << other;
    if (!first) before_[other] |= Robots{1} << robot;
  }
  if (possible && !leads_back(robot)) {
    chosen_ |= Robots{1} << robot;
    return true;
  }
  before_ = before;
  moves_[robot] = nullptr;
  to_[robot] = from_[robot];
  return false;
}

/// Whether a robot would have to go after itself.
bool JointStep::leads_back(int robot) const {
  Robots after = before_[robot];
  for (Robots known = 0; after != known;) {
    known = after;
    for (int other = 0; other < robots(); ++other) {
      if (known >> other & 1U) after |= before_[other];
    }
  }
  return after >> robot & 1U;
}

std::vector<int> JointStep::in_the_way(int robot, const PlaceMove& move) const {
  std::vector<int> found;
  for (int other = 0; other < robots(); ++other) {
    if (other != robot && blocks(&move, from_[other])) found.push_back(other);
  }
  return found;
}

std::vector<int> JointStep::order() const {
  std::vector<int> order;
  Robots waiting = 0;
  for (int robot = 0; robot < robots(); ++robot) {
    if (moves_[robot] != nullptr) waiting |= Robots{1} << robot;
  }
  while (waiting != 0) {
    for (int robot = 0; robot < robots(); ++robot) {
      if (!(waiting >> robot & 1U)) continue;
      bool is_next = true;
      for (int other = 0; other < robots(); ++other)
        is_next = is_next && !((waiting >> other & 1U) && (before_[other] >> robot & 1U));
      if (!is_next) continue;
      order.push_back(robot);
      waiting &= ~(Robots{1} << robot);
    }
  }
  return order;
}

}  // namespace mocha
