#include "planning/candidates/peer_discs.h"

#include "safety/requirement.h"

namespace mocha {

bool stands(const MovingObstacle& peer, double t) {
  constexpr double kSoon_s = 0.5;
  return peer.rest_time() <= t + kSoon_s;
}

BlockedDisc peer_keep_out(const MovingObstacle& peer, double t, const RobotModel& robot,
                          double slack_m) {
  const auto disc = peer.at(t);
  return {disc.centre, disc.radius_m + distance_to_peers_m(robot) + slack_m};
}

}  // namespace mocha
