#include "planning/peer_discs.h"

#include "safety/margin_budget.h"

namespace mocha {

bool stands(const MovingObstacle& peer, double t) {
  constexpr double kSoon_s = 0.5;
  return peer.rest_time() <= t + kSoon_s;
}

double distance_to_peers_m(const RobotModel& robot) {
  return robot.footprint.circumscribed_radius_m() + robot.peer_clearance_m +
         MarginBudget::of(robot).peer_margin_m();
}

BlockedDisc kept_from(const MovingObstacle& peer, double t, const RobotModel& robot,
                      double slack_m) {
  const auto disc = peer.at(t);
  return {disc.centre, disc.radius_m + distance_to_peers_m(robot) + slack_m};
}

}  // namespace mocha
