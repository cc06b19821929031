#include "planning/candidates/maneuver.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace mocha {

Maneuver whole(Motion motion, double join_s, bool at_once, const char* words) {
  constexpr double kNever_s = std::numeric_limits<double>::infinity();
  return {join_s,       std::move(motion), kNever_s,          kNever_s, -kNever_s,
          std::nullopt, at_once,           Follows::kNothing, words};
}

bool is_alone(const ManeuverStart& start) {
  constexpr double kAlone_m = 5.0;  // what two robots drive towards each other in a few seconds
  const Vector2 place = start.committed.position(start.now_s);
  const auto& peers = start.scene.peers;
  return std::all_of(peers.begin(), peers.end(), [&](const auto& peer) {
    return (peer->at(start.now_s).centre - place).norm() > kAlone_m;
  });
}

}  // namespace mocha
