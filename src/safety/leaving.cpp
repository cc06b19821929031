#include "safety/leaving.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kStep_s = 0.05;     // between the moments at which a leaving robot is looked at
constexpr double kWayStep_s = 0.01;  // the same, where it is the way that is measured
// So much may the disc of a standing robot reach into that of a peer: both overstate the bodies.
constexpr double kPeersOverstated_m = 0.05;
// With so much more room than the margin, a robot has left.
constexpr double kLeft_m = 0.01;
// A leaving robot is looked at after so much way of any of its points: its room changes by no more.
constexpr double kStage_m = 0.5 * kLeft_m;

/// Where a leaving robot is looked at.
struct Stage {
  double time_s;
  double way_m;   ///< so far
  double room_m;  ///< the most so far
};

/// Moves a stage on along the motion, to its end at most; `arm_m` is that of a corner.
void advance(Stage& stage, const Motion& motion, double arm_m) {
  Pose pose = motion.at(stage.time_s).pose;
  for (double swept_m = 0.0; swept_m < kStage_m && stage.time_s < motion.end_time();) {
    stage.time_s = std::min(stage.time_s + kWayStep_s, motion.end_time());
    const Pose then = motion.at(stage.time_s).pose;
    const double step_m = (then.position - pose.position).norm();
    swept_m += step_m + arm_m * std::abs(wrap_angle(then.yaw_rad - pose.yaw_rad));
    stage.way_m += step_m;
    pose = then;
  }
}

}  // namespace

Violation check_clearance_or_leaving(const Motion& motion, const Footprint& footprint,
                                     const ObstacleField<2>& field, const SpeedMargin& margin,
                                     const Leaving& leaving, double from_s) {
  const Violation strict = check_clearance(motion, footprint, field, margin, from_s);
  if (!strict) return strict;
  const auto gap_at = [&](double t) { return clearance_m(motion.at(t).pose, footprint, field); };
  const auto room_at = [&](double t) {
    return gap_at(t) - (margin.at(motion.at(t).speed) - margin.still_m) - Leaving::kSlack_m;
  };
  Stage stage{std::max(from_s, motion.start_time()), 0.0, room_at(from_s)};
  const double left_m = margin.still_m + kLeft_m;
  if (stage.room_m >= left_m || gap_at(from_s) <= -leaving.deepest_m) return strict;
  const double arm_m = footprint.is_disc() ? 0.0 : footprint.circumscribed_radius_m();
  while (stage.room_m < left_m - kStage_m && stage.way_m < leaving.way_m) {
    const double here_s = stage.time_s;
    const double required_m = leaving.required_m(stage.room_m, margin.still_m);
    advance(stage, motion, arm_m);
    const Violation closer = check_clearance(motion, footprint, field,
                                             {required_m, margin.per_speed2}, here_s, stage.time_s);
    if (closer || stage.time_s >= motion.end_time()) return closer;
    stage.room_m = std::max(stage.room_m, room_at(stage.time_s));
  }
  return check_clearance(motion, footprint, field, margin, stage.time_s);
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
  if (here_m - Leaving::kSlack_m >= clearance_m || here_m <= -kPeersOverstated_m) return strict;
  if (const Violation closer = prove(here_m - Leaving::kSlack_m, from_s)) return closer;
  const double end_s = std::min(until_s, std::max(motion.end_time(), other.rest_time()));
  for (double t = from_s; t < end_s; t += kStep_s) {
    if (gap_at(t) >= clearance_m + Leaving::kSlack_m) return prove(clearance_m, t);
  }
  return {};
}

}  // namespace mocha
