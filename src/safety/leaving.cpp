#include "safety/leaving.h"

#include <algorithm>
#include <limits>
#include <vector>

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
constexpr double kStage_m = 0.02;
constexpr int kFirst = 15;  // after so many it has the floor
constexpr int kAll = 50;    // and then all of its margin

double clearance_at(const Pose& pose, const Footprint& footprint, const ObstacleField<2>& field) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& disc : footprint.cover()) {
    nearest = std::min(nearest, field.distance_bound(cover_centre(pose, disc)) - disc.radius_m);
  }
  return nearest;
}

/// The gap to ask for, where `gaps_m` are those of all stages so far, the present one included.
double required_gap_m(const std::vector<double>& gaps_m, double margin_m, const Leaving& leaving) {
  const int stage = static_cast<int>(gaps_m.size()) - 1;
  if (stage >= kAll) return margin_m;
  double required_m = stage >= kFirst ? std::min(leaving.floor_m, margin_m) : gaps_m[0];
  for (int i = 0; i <= stage; ++i) {
    const double share = static_cast<double>(stage - i) / kAll;
    required_m = std::max(required_m, gaps_m[i] + share * share * (margin_m - gaps_m[i]));
  }
  return std::min(required_m, margin_m);
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
  std::vector<double> gaps_m = {gap_at(from_s) - kSlack_m};
  if (gaps_m[0] >= margin_m || gaps_m[0] + kSlack_m <= -kOverstated_m) return strict;
  double t = std::max(from_s, motion.start_time());
  for (;;) {
    const double required_m = required_gap_m(gaps_m, margin_m, leaving);
    if (required_m >= margin_m) return check_clearance(motion, footprint, field, margin_m, t);
    const double next_s = time_after(motion, t, kStage_m);
    const Violation closer = check_clearance(motion, footprint, field, required_m, t, next_s);
    if (closer || next_s >= motion.end_time()) return closer;
    t = next_s;
    gaps_m.push_back(gap_at(t) - kSlack_m);
  }
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
