#include "planning/escape_proof.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace mocha {
namespace {

constexpr double kSlack_m =
    0.003;                        // the proofs may refuse what is within a millimetre of its limit
constexpr double kStep_s = 0.05;  // between the moments at which a leaving robot is looked at
// So much may the discs that cover a standing robot reach into what is around: both overstate what
// they stand for.
constexpr double kOverstated_m = 0.05;

double clearance_at(const Pose& pose, const Footprint& footprint, const ObstacleField<2>& field) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& disc : footprint.cover()) {
    nearest = std::min(nearest, field.distance_bound(cover_centre(pose, disc)) - disc.radius_m);
  }
  return nearest;
}

/// `prove(margin, from)` is the strict proof, `room(t)` the room at a moment.
Violation or_leaving(double margin_m, double from_s, double until_s,
                     const std::function<Violation(double, double)>& prove,
                     const std::function<double(double)>& room) {
  const Violation strict = prove(margin_m, from_s);
  if (!strict) return strict;
  const double here = room(from_s);
  if (here - kSlack_m >= margin_m || here <= -kOverstated_m) return strict;
  const Violation closer = prove(here - kSlack_m, from_s);
  if (closer) return closer;
  for (double t = from_s; t < until_s; t += kStep_s) {
    if (room(t) >= margin_m + kSlack_m) return prove(margin_m, t);
  }
  return {};
}

}  // namespace

Violation check_clearance_or_leaving(const Motion& motion, const Footprint& footprint,
                                     const ObstacleField<2>& field, double margin_m,
                                     double from_s) {
  return or_leaving(
      margin_m, from_s, motion.end_time(),
      [&](double margin, double from) {
        return check_clearance(motion, footprint, field, margin, from);
      },
      [&](double t) { return clearance_at(motion.at(t).pose, footprint, field); });
}

Violation check_separation_or_leaving(const Motion& motion, double own_radius_m,
                                      const MovingObstacle& other, double clearance_m,
                                      double from_s, double until_s) {
  return or_leaving(
      clearance_m, from_s, std::min(until_s, std::max(motion.end_time(), other.rest_time())),
      [&](double clearance, double from) {
        return check_separation(motion, own_radius_m, other, clearance, from, until_s);
      },
      [&](double t) {
        const auto disc = other.at(t);
        return (motion.position(t) - disc.centre).norm() - own_radius_m - disc.radius_m;
      });
}

}  // namespace mocha
