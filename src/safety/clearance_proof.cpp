#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "safety/certificate.h"
#include "safety/curve_arc.h"
#include "safety/drive_piece.h"
#include "safety/worst_value.h"

namespace mocha {
namespace {

constexpr double kReportLength_s = 2.0;

/// Bounds on where a robot is during an interval of time: the base within `travel_m` of `place`,
/// the heading's unit vector within `swing` of `heading` (infinite where the heading is not
/// defined), no faster than `max_speed`.
struct Sweep {
  Vector2 place;
  Vector2 heading;
  double travel_m;
  double swing;
  double max_speed;     ///< [m/s]
  double speed_change;  ///< [m/s] in the interval, about
};

/// An interval of a drive.
struct DriveArc : CurveArc<2, 5> {
  Bernstein<2, 4> course;
  int drive_direction;

  std::pair<DriveArc, DriveArc> halves() const {
    const auto paths = CurveArc::halves();
    const auto courses = split(course);
    return {{paths.first, courses.first, drive_direction},
            {paths.second, courses.second, drive_direction}};
  }

  Sweep sweep(const DriveArc& second_half) const {
    const auto path = CurveArc::sweep(second_half);
    const Vector2 along = second_half.course.col(0);
    const auto [slowest, fastest] = speeds();
    Sweep sweep{path.place,       drive_direction * along.normalized(), path.travel_m, 0.0, fastest,
                fastest - slowest};
    for (int j = 0; j < course.cols(); ++j) {
      // The courses between lie within the widest angle to a control point; a chord is shorter than
      // the tangent.
      const double ahead = along.dot(course.col(j));
      const double aside = std::abs(along.x() * course(1, j) - along.y() * course(0, j));
      const double tangent = ahead > 0.0 ? aside / ahead : std::numeric_limits<double>::infinity();
      sweep.swing = std::max(sweep.swing, tangent);
    }
    return sweep;
  }

  /// Of the control points of the velocity: the base is no faster than the second.
  std::pair<double, double> speeds() const {
    constexpr int kDegree = 5;
    double least2 = std::numeric_limits<double>::infinity();
    double most2 = 0.0;
    for (int j = 0; j < kDegree; ++j) {
      const double step2 = (position.col(j + 1) - position.col(j)).squaredNorm();
      least2 = std::min(least2, step2);
      most2 = std::max(most2, step2);
    }
    const double rate = kDegree / duration_s;
    return {rate * std::sqrt(least2), rate * std::sqrt(most2)};
  }
};

/// An interval of a turn in place: how its heading changes.
struct TurnArc : CurveArc<1, 5> {
  Pose start;

  std::pair<TurnArc, TurnArc> halves() const {
    const auto parts = CurveArc::halves();
    return {{parts.first, start}, {parts.second, start}};
  }

  Sweep sweep(const TurnArc& second_half) const {
    const auto turned = CurveArc::sweep(second_half);
    const double yaw = start.yaw_rad + turned.place[0];
    return {start.position, {std::cos(yaw), std::sin(yaw)}, 0.0, turned.travel_m, 0.0, 0.0};
  }
};

/// What has to stay clear of what.
class Keepout {
 public:
  Keepout(const Footprint& footprint, const ObstacleField<2>& field, const SpeedMargin& margin)
      : footprint_(footprint), field_(field), margin_(margin) {
    for (const CoverDisc& disc : footprint.cover().discs())
      arm_m_ = std::max(arm_m_, disc.offset_m.norm());
  }

  bool clear(const Pose& pose) const {
    return clear(
        {pose.position, {std::cos(pose.yaw_rad), std::sin(pose.yaw_rad)}, 0.0, 0.0, 0.0, 0.0});
  }

  /// A proof that all cover discs keep the margin throughout the interval.
  bool clear(const Sweep& sweep) const {
    const double margin_m = margin_.at(sweep.max_speed);
    return footprint_.cover().all([&](const DiscTree::Node& disc) {
      const double needed_m = disc.radius_m + margin_m + moved_m(sweep, disc.arm_m);
      return field_.distance_bound(sweep.place + turned(disc.offset_m, sweep.heading)) >= needed_m;
    });
  }

  /// How far the discs move in the interval, and by how much their margin changes.
  double sweep_m(const Sweep& sweep) const {
    const double slowest = sweep.max_speed - sweep.speed_change;
    return moved_m(sweep, arm_m_) + margin_.at(sweep.max_speed) - margin_.at(slowest);
  }

  double clearance_at(const Pose& pose) const { return clearance_m(pose, footprint_, field_); }
  double margin_at(double speed) const { return margin_.at(speed); }

 private:
  /// How far a point moves in the interval, at most, that is `arm_m` off the base.
  static double moved_m(const Sweep& sweep, double arm_m) {
    return sweep.travel_m + (arm_m == 0.0 ? 0.0 : arm_m * sweep.swing);
  }

  const Footprint& footprint_;
  const ObstacleField<2>& field_;
  SpeedMargin margin_;
  double arm_m_ = 0.0;  // of the disc farthest off the base
};

std::optional<double> first_contact(const Motion& motion, int phase, const Keepout& keepout,
                                    double from_s, double until_s) {
  const double start = motion.phase_start_time(phase);
  const Phase& what = motion.phases()[phase];
  if (const auto* turn = std::get_if<TurnPhase>(&what)) {
    const double u = std::clamp((from_s - start) / turn->duration_s, 0.0, 1.0);
    const double left_s = (1.0 - u) * turn->duration_s;
    const TurnArc arc{
        {split(yaw_change(*turn), u).second, start + turn->duration_s - left_s, left_s},
        turn->start};
    return first_unclear(arc, keepout);
  }
  if (const auto* stand = std::get_if<StandPhase>(&what)) {
    return keepout.clear(stand->pose) ? std::nullopt : std::make_optional(std::max(start, from_s));
  }
  for (const DrivePiece& piece : drive_pieces(motion, phase, from_s)) {
    if (piece.start_s >= until_s) break;
    const DriveArc arc{
        {piece.position, piece.start_s, piece.duration_s}, piece.course, piece.drive_direction};
    if (const auto t = first_unclear(arc, keepout)) return t;
  }
  return std::nullopt;
}

/// The violation that begins at `t`, with what lacks the most in the stretch that begins there.
Violation report(const Motion& motion, const Keepout& keepout, double t) {
  Violation violation;
  violation.term = ViolatedTerm::kClearance;
  violation.time_s = t;
  violation.place = motion.position(t);
  double least_spare_m = std::numeric_limits<double>::infinity();
  const auto spare_m = [&](double when) {
    const MotionState state = motion.at(when);
    const double clearance_m = keepout.clearance_at(state.pose);
    const double margin_m = keepout.margin_at(state.speed);
    if (clearance_m - margin_m < least_spare_m) {
      least_spare_m = clearance_m - margin_m;
      violation.value = clearance_m;
      violation.limit = margin_m;
    }
    return clearance_m - margin_m;
  };
  worst_value(spare_m, std::less<>(), 0.0, t, std::min(t + kReportLength_s, motion.end_time()));
  return violation;
}

}  // namespace

double clearance_m(const Pose& pose, const Footprint& footprint, const ObstacleField<2>& field) {
  return footprint.cover().least([&](const CoverDisc& disc) {
    return field.distance_bound(cover_centre(pose, disc)) - disc.radius_m;
  });
}

Violation check_clearance(const Motion& motion, const Footprint& footprint,
                          const ObstacleField<2>& field, const SpeedMargin& margin, double from_s,
                          double until_s) {
  const Keepout keepout(footprint, field, margin);
  if (from_s >= motion.end_time()) {
    return keepout.clear(motion.end_pose()) ? Violation{} : report(motion, keepout, from_s);
  }
  for (int i = 0; i < static_cast<int>(motion.phases().size()); ++i) {
    if (motion.phase_start_time(i) + duration_s(motion.phases()[i]) <= from_s) continue;
    if (i > 0 && motion.phase_start_time(i) >= until_s) break;
    const auto t = first_contact(motion, i, keepout, from_s, until_s);
    if (t && *t < until_s) return report(motion, keepout, *t);
    if (t) break;
  }
  return {};
}

}  // namespace mocha
