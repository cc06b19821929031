#include "safety/leaving.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mocha {
namespace {

// The proofs may refuse what is within a millimetre of its limit.
constexpr double kSlack_m = 0.003;
constexpr double kStep_s = 0.05;     // between the moments at which a leaving robot is looked at
constexpr double kWayStep_s = 0.01;  // the same, where it is the way that is measured
// So much may the cover of a standing robot reach into cells of the map, and its disc into that of
// a peer: all of them overstate what they stand for, the cover by kCoverTolerance_m at most.
constexpr double kCellsOverstated_m = 0.04;
constexpr double kPeersOverstated_m = 0.05;
// A leaving robot is looked at after so much way, or when a corner has turned so far.
constexpr double kStage_m = 0.02;
constexpr double kTurned_m = 0.005;

/// Where a leaving robot is looked at.
struct Stage {
  double time_s;
  double way_m = 0.0;     ///< so far
  double turned_m = 0.0;  ///< by a corner, so far
  double room_m = 0.0;
};

/// The room to ask for from the last of these stages on, until a corner has turned by `turned_m`.
double required_room_m(const std::vector<Stage>& stages, double turned_m, double margin_m,
                       const Leaving& leaving) {
  constexpr double kRounding_m = 1e-9;
  const double way_m = stages.back().way_m + kRounding_m;
  if (way_m >= leaving.way_m) return margin_m;
  double required_m = -std::numeric_limits<double>::infinity();
  for (const Stage& stage : stages) {
    required_m = std::max(required_m, leaving.required_m(stage.room_m, way_m - stage.way_m,
                                                         turned_m - stage.turned_m, margin_m));
  }
  return required_m;
}

/// The stage after this one, the motion's end at the latest; `arm_m` is that of a corner.
Stage stage_after(const Stage& stage, const Motion& motion, double arm_m) {
  Stage next = stage;
  Pose pose = motion.at(stage.time_s).pose;
  for (double left = 1.0; next.time_s < motion.end_time(); next.time_s += kWayStep_s) {
    const Pose then = motion.at(next.time_s + kWayStep_s).pose;
    const double step_m = (then.position - pose.position).norm();
    const double turned_m = arm_m * std::abs(wrap_angle(then.yaw_rad - pose.yaw_rad));
    const double step = step_m / kStage_m + turned_m / kTurned_m;
    if (step >= left) {
      next.way_m += step_m * left / step;
      next.turned_m += turned_m * left / step;
      next.time_s += kWayStep_s * left / step;
      break;
    }
    left -= step;
    next.way_m += step_m;
    next.turned_m += turned_m;
    pose = then;
  }
  next.time_s = std::min(next.time_s, motion.end_time());
  return next;
}

}  // namespace

Violation check_clearance_or_leaving(const Motion& motion, const Footprint& footprint,
                                     const ObstacleField<2>& field, const SpeedMargin& margin,
                                     const Leaving& leaving, double from_s) {
  const Violation strict = check_clearance(motion, footprint, field, margin, from_s);
  if (!strict) return strict;
  const auto gap_at = [&](double t) { return clearance_m(motion.at(t).pose, footprint, field); };
  const auto room_at = [&](double t) {
    return gap_at(t) - margin.per_speed_s * std::abs(motion.at(t).speed) - kSlack_m;
  };
  std::vector<Stage> stages = {{std::max(from_s, motion.start_time()), 0.0, 0.0, room_at(from_s)}};
  if (stages[0].room_m >= margin.still_m || gap_at(from_s) <= -kCellsOverstated_m) return strict;
  const double arm_m = footprint.is_disc() ? 0.0 : footprint.circumscribed_radius_m();
  for (;;) {
    const Stage& here = stages.back();
    Stage next = stage_after(here, motion, arm_m);
    const double required_m = required_room_m(stages, next.turned_m, margin.still_m, leaving);
    if (required_m >= margin.still_m || here.room_m >= margin.still_m)
      return check_clearance(motion, footprint, field, margin, here.time_s);
    const Violation closer = check_clearance(
        motion, footprint, field, {required_m, margin.per_speed_s}, here.time_s, next.time_s);
    if (closer || next.time_s >= motion.end_time()) return closer;
    next.room_m = room_at(next.time_s);
    stages.push_back(next);
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
  if (here_m - kSlack_m >= clearance_m || here_m <= -kPeersOverstated_m) return strict;
  if (const Violation closer = prove(here_m - kSlack_m, from_s)) return closer;
  const double end_s = std::min(until_s, std::max(motion.end_time(), other.rest_time()));
  for (double t = from_s; t < end_s; t += kStep_s) {
    if (gap_at(t) >= clearance_m + kSlack_m) return prove(clearance_m, t);
  }
  return {};
}

}  // namespace mocha
