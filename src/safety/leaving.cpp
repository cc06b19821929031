#include "safety/leaving.h"

#include <algorithm>
#include <limits>

namespace mocha {
namespace {

// The proofs may refuse what is within a millimetre of its limit.
constexpr double kSlack_m = 0.003;
constexpr double kStep_s = 0.05;     // between the moments at which a leaving robot is looked at
constexpr double kWayStep_s = 0.01;  // the same, where it is the way that is measured
// So much may the discs that cover a standing robot reach into what is around: both overstate what
// they stand for.
constexpr double kOverstated_m = 0.05;
// The way of a leaving robot, in stages.
constexpr double kStage_m = 0.05;
constexpr int kFirst = 6;  // after so many it has the floor
constexpr int kAll = 20;   // and then all of its margin

double clearance_at(const Pose& pose, const Footprint& footprint, const ObstacleField<2>& field) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& disc : footprint.cover()) {
    nearest = std::min(nearest, field.distance_bound(cover_centre(pose, disc)) - disc.radius_m);
  }
  return nearest;
}

/// The time at which the motion has driven `way_m` from `from_s` on; its end where that is sooner.
double time_after(const Motion& motion, double from_s, double way_m) {
  Vector2 place = motion.position(from_s);
  for (double t = from_s; t < motion.end_time(); t += kWayStep_s) {
    const Vector2 next = motion.position(t + kWayStep_s);
    const double step_m = (next - place).norm();
    if (step_m >= way_m) return std::min(t + kWayStep_s * way_m / step_m, motion.end_time());
    way_m -= step_m;
    place = next;
  }
  return motion.end_time();
}

}  // namespace

Violation check_clearance_or_leaving(const Motion& motion, const Footprint& footprint,
                                     const ObstacleField<2>& field, double margin_m,
                                     const Leaving& leaving, double from_s) {
  const Violation strict = check_clearance(motion, footprint, field, margin_m, from_s);
  if (!strict) return strict;
  const auto gap_at = [&](double t) { return clearance_at(motion.at(t).pose, footprint, field); };
  double gap_m = gap_at(from_s) - kSlack_m;  // the room that it must not lose any more
  if (gap_m >= margin_m || gap_m + kSlack_m <= -kOverstated_m) return strict;
  double t = std::max(from_s, motion.start_time());
  for (int stage = 0; stage < kAll && gap_m < margin_m; ++stage) {
    if (stage >= kFirst) gap_m = std::max(gap_m, std::min(leaving.floor_m, margin_m));
    const double next_s = time_after(motion, t, kStage_m);
    const Violation closer = check_clearance(motion, footprint, field, gap_m, t, next_s);
    if (closer) return closer;
    t = next_s;
    if (t >= motion.end_time()) return {};
    gap_m = std::max(gap_m, gap_at(t) - kSlack_m);
  }
  return check_clearance(motion, footprint, field, margin_m, t);
}

Violation check_separation_or_leaving(const Motion& motion, double own_radius_m,
                                      const MovingObstacle& other, double clearance_m,
                                      double from_s, double until_s) {
  const auto prove = [&](double clearance, double from) {
    return check_separation(motion, own_radius_m, other, clearance, from, until_s);
  };
  const auto gap_at = [&](double t) {
    const auto disc = other.at(t);
    return (motion.position(t) - disc.centre).norm() - own_radius_m - disc.radius_m;
  };
  const Violation strict = prove(clearance_m, from_s);
  if (!strict) return strict;
  const double here_m = gap_at(from_s);
  if (here_m - kSlack_m >= clearance_m || here_m <= -kOverstated_m) return strict;
  if (const Violation closer = prove(here_m - kSlack_m, from_s)) return closer;
  const double end_s = std::min(until_s, std::max(motion.end_time(), other.rest_time()));
  for (double t = from_s; t < end_s; t += kStep_s) {
    if (gap_at(t) >= clearance_m + kSlack_m) return prove(clearance_m, t);
  }
  return {};
}

}  // namespace mocha
