#include "safety/stop_proof.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr double kRounding_m = 1e-3;

}  // namespace

Violation check_stops(const Motion& motion, double own_radius_m, const MovingObstacle& peer,
                      double clearance_m, const StopOptions& options, double from_s) {
  const auto promised = peer.promised();
  if (!promised) return {};
  const double radii_m = own_radius_m + peer.at(from_s).radius_m;
  const double here_m = (motion.position(from_s) - promised->motion.position(from_s)).norm();
  const double required_m = std::min(radii_m + clearance_m, here_m - kRounding_m);
  const auto meeting = first_stop_meeting({motion, options.braking}, *promised, required_m,
                                          options.reaction_s, from_s);
  if (!meeting) return {};
  return {ViolatedTerm::kSeparation,     meeting->brakes_s,    meeting->place,
          meeting->distance_m - radii_m, required_m - radii_m, peer.name()};
}

}  // namespace mocha
