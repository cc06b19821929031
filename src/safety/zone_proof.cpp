#include <algorithm>
#include <functional>
#include <optional>

#include "safety/certificate.h"
#include "safety/curve_arc.h"
#include "safety/curve_piece.h"
#include "safety/limit_search.h"
#include "safety/worst_value.h"
#include "world/primitive.h"

namespace mocha {
namespace {

/// Where the base is during an interval of time, until when, and how fast at most.
struct Passage {
  CurveSweep<2> sweep;
  double end_s;
  double max_speed;
};

struct PassageArc : CurveArc<2, 5> {
  std::pair<PassageArc, PassageArc> halves() const {
    const auto parts = CurveArc::halves();
    return {{parts.first}, {parts.second}};
  }

  Passage sweep(const PassageArc& second_half) const {
    constexpr int kDegree = 5;
    const double step_m =
        (position.rightCols<kDegree>() - position.leftCols<kDegree>()).colwise().norm().maxCoeff();
    return {CurveArc::sweep(second_half), start_s + duration_s, kDegree * step_m / duration_s};
  }
};

/// What the base keeps to while it may be over an area, or is off it.
class SlowPassage {
 public:
  SlowPassage(const SpeedZones& zones, const SpeedZones::Area& area) : zones_(zones), area_(area) {}

  bool clear(const Passage& passage) const {
    return passage.max_speed <= kLimitSlack * zones_.limit_at(area_, passage.end_s) ||
           distance_m(area_.area, passage.sweep.place) - passage.sweep.travel_m >= zones_.reach_m();
  }
  double sweep_m(const Passage& passage) const { return passage.sweep.travel_m; }

  bool is_off(const Eigen::AlignedBox2d& box) const {
    return box.exteriorDistance(area_.box) >= zones_.reach_m();
  }
  bool counts_at(const Vector2& place) const {
    return distance_m(area_.area, place) < zones_.reach_m();
  }
  double limit_at(double t) const { return zones_.limit_at(area_, t); }
  const SpeedZones::Area& area() const { return area_; }

 private:
  const SpeedZones& zones_;
  const SpeedZones::Area& area_;
};

std::optional<double> first_haste(const CurvePiece<2, 5>& piece, const SlowPassage& passage) {
  if (piece.max_speed() <= passage.area().max_speed) return std::nullopt;
  const Eigen::AlignedBox2d box(Vector2(piece.position.rowwise().minCoeff()),
                                Vector2(piece.position.rowwise().maxCoeff()));
  if (passage.is_off(box)) return std::nullopt;
  return first_unclear(PassageArc{{piece.position, piece.start_s, piece.duration_s}}, passage);
}

std::optional<double> first_haste(const Motion& motion, const SlowPassage& passage, double from_s) {
  for (int i = 0; i < static_cast<int>(motion.phases().size()); ++i) {
    const auto* drive = std::get_if<DrivePhase>(&motion.phases()[i]);
    const double start = motion.phase_start_time(i);
    if (!drive || start + drive->path.duration() <= from_s) continue;
    for (const auto& piece : curve_pieces(drive->path, start, from_s)) {
      if (const auto t = first_haste(piece, passage)) return t;
    }
  }
  return std::nullopt;
}

/// With the greatest excess of the stretch that begins at `t`.
Violation report(const Motion& motion, const SlowPassage& passage, double t) {
  constexpr double kLength_s = 5.0;
  Violation violation;
  violation.term = ViolatedTerm::kZoneSpeed;
  violation.time_s = t;
  violation.place = motion.position(t);
  violation.peer = passage.area().name;
  violation.value = motion.velocity(t).norm();
  violation.limit = passage.limit_at(t);
  double most = violation.value - violation.limit;
  const auto excess = [&](double when) {
    const MotionState state = motion.at(when);
    if (!passage.counts_at(state.pose.position)) return 0.0;
    const double speed = state.velocity.norm();
    const double over = speed - passage.limit_at(when);
    if (over > most) {
      most = over;
      violation.value = speed;
      violation.limit = passage.limit_at(when);
    }
    return over;
  };
  worst_value(excess, std::greater<>(), 0.0, t, std::min(t + kLength_s, motion.end_time()));
  return violation;
}

}  // namespace

Violation check_speed_zones(const Motion& motion, const SpeedZones& zones, double from_s) {
  Violation first;
  for (const SpeedZones::Area& area : zones.areas()) {
    const SlowPassage passage(zones, area);
    const auto t = first_haste(motion, passage, from_s);
    if (t && (!first || *t < first.time_s)) first = report(motion, passage, *t);
  }
  return first;
}

}  // namespace mocha
