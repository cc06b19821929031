#include "fleet/protocol/neighbourhood.h"

#include <algorithm>

namespace mocha {

std::optional<double> Neighbourhood::distance_m(const Peer& peer) const {
  if (binding_.empty() || peer.binding.empty()) return std::nullopt;
  const Vector2 here = binding_.position(now_);
  if (peer.clock.reading(now_)) return (here - peer.binding.position(now_)).norm();
  // Of a clock that is not known, there is no telling how far the peer has got.
  Eigen::AlignedBox2d ways;
  for (const Reservation& each : peer.binding.reservations())
    ways.extend(each.trajectory.motion->box());
  return ways.exteriorDistance(here);
}

bool Neighbourhood::is_near(const Peer& peer, double spare_s) const {
  const auto apart_m = distance_m(peer);
  const double age_s = now_ - peer.placed_s;
  if (!apart_m || age_s > options_.reach_timeout_s) return true;
  // What was confirmed is as old as the message was on its way, and may be off by what is driven
  // since in each direction, and by what the clock may be wrong.
  const double since_s = age_s + options_.delta_dc_s + spare_s;
  const double mistimed_s = peer.clock.error_s(now_).value_or(0.0);
  const double unknown_m = options_.reach.fleet_speed * (2.0 * since_s + mistimed_s);
  return *apart_m <= near_m(peer) + unknown_m;
}

double Neighbourhood::urgency(const Peer& peer) const {
  if (is_near(peer)) return 1.0;
  const double times = *distance_m(peer) / near_m(peer);
  return 1.0 / (times * times);
}

double Neighbourhood::near_m(const Peer& peer) const {
  const CommittedTrajectory& theirs = peer.binding.newest();
  const double radii_m = binding_.newest().footprint_radius_m + theirs.footprint_radius_m;
  return options_.reach.promise_m + peer.promise_reach_m + radii_m +
         std::max(options_.peer_clearance_m, options_.stop_clearance_m);
}

}  // namespace mocha
