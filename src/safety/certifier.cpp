#include "safety/certifier.h"

#include <algorithm>
#include <cmath>

#include "safety/certificate.h"
#include "safety/stop_proof.h"

namespace mocha {
namespace {

/// The earliest of the violations that it is told.
class First {
 public:
  void consider(const Violation& other) {
    if (other && (!first_ || other.time_s < first_.time_s)) first_ = other;
  }
  const Violation& get() const { return first_; }

 private:
  Violation first_;
};

}  // namespace

Violation certify(const Motion& motion, const Footprint& footprint, const Scene& scene,
                  const Requirement& requirement) {
  const double from_s =
      std::isfinite(requirement.from_s) ? requirement.from_s : motion.start_time();
  First first;
  if (requirement.limits) {
    const double limits_from_s = std::max(from_s, requirement.limits_from_s);
    first.consider(check_limits(motion, *requirement.limits, limits_from_s));
    if (scene.speed_zones)
      first.consider(check_speed_zones(motion, *scene.speed_zones, limits_from_s));
  }
  first.consider(check_clearance_or_leaving(motion, footprint, *scene.obstacles,
                                            requirement.obstacle_margin, requirement.leaving,
                                            from_s));
  if (requirement.unseen_margin) {
    Violation unseen = check_clearance_or_leaving(
        motion, footprint, *scene.unseen, *requirement.unseen_margin, requirement.leaving, from_s);
    if (unseen) unseen.term = ViolatedTerm::kUnseenSpace;
    first.consider(unseen);
  }
  const double radius_m = footprint.circumscribed_radius_m();
  for (const MovingThing& thing : kept_apart(scene, requirement.from(from_s))) {
    const double until_s = std::min(thing.until_s, requirement.until_s);
    if (until_s <= from_s) continue;
    first.consider(check_separation_or_leaving(motion, radius_m, *thing.obstacle,
                                               thing.keep_m - radius_m, from_s, until_s));
  }
  if (requirement.stops) {
    for (const auto& peer : scene.peers) {
      first.consider(check_stops(motion, radius_m, *peer, requirement.stop_clearance_m,
                                 *requirement.stops, from_s));
    }
  }
  return first.get() && first.get().time_s < requirement.until_s ? first.get() : Violation{};
}

}  // namespace mocha
