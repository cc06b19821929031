#include "planning/replanner/certified_part.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fleet/wire/wire_format.h"
#include "safety/certifier.h"
#include "trajectory/splice.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.1;  // between the places where braking is tried

/// One maneuver, to be cut where it can be promised.
class Cutter {
 public:
  Cutter(const ManeuverStart& start, const Maneuver& maneuver, RequirementName required,
         Motion onward)
      : start_(start), maneuver_(maneuver), required_(required), onward_(std::move(onward)) {}

  std::optional<CertifiedPart> longest() {
    const Violation obstacle = violation_of(onward_, maneuver_.join_s);
    double brake_s = maneuver_.brake_until_s;
    if (onward_.end_time() <= brake_s) {
      if (!obstacle) {
        if (auto found = promised(onward_, onward_.end_time(), {})) return found;
      }
      if (maneuver_.brake_from_s >= onward_.end_time()) return std::nullopt;
      brake_s = onward_.end_time();
    }
    if (obstacle) brake_s = std::min(brake_s, obstacle.time_s);
    return braking_about(std::max(brake_s, maneuver_.brake_from_s), obstacle);
  }

 private:
  Violation violation_of(const Motion& motion, double limits_from_s) const {
    if (required_ == RequirementName::kNone) return {};
    return certify(motion, start_.robot.footprint, start_.scene,
                   start_.requirements[required_].from(start_.now_s).joining_at(limits_from_s));
  }

  /// The latest braking before `brake_s`; or the first one after it, where the robot is in the way
  /// of something only once it stops.
  std::optional<CertifiedPart> braking_about(double brake_s, const Violation& obstacle) {
    if (auto found = braking_at(brake_s, obstacle)) return found;
    const double last_s = obstacle || maneuver_.brake_from_s == maneuver_.brake_until_s
                              ? brake_s
                              : std::min(start_.scene.predicted_until_s, onward_.end_time());
    for (double t = brake_s + kStep_s; t < last_s; t += kStep_s) {
      if (auto found = braking_at(t, obstacle)) return found;
    }
    while (brake_s > maneuver_.brake_from_s) {
      brake_s = std::max(brake_s - kStep_s, maneuver_.brake_from_s);
      if (auto found = braking_at(brake_s, obstacle)) return found;
    }
    return std::nullopt;
  }

  /// What is to be driven on from later does not end in the midst of a turn in place: it would have
  /// to begin anew there.
  std::optional<CertifiedPart> braking_at(double t, const Violation& cut_by) {
    const double brake_s = maneuver_.at_once ? t : onward_.switch_time(t);
    const MotionOrFault braked =
        try_brake(onward_, onward_.start_time(), brake_s, maneuver_.braking.value());
    return braked ? promised(braked.motion, brake_s, cut_by) : std::nullopt;
  }

  /// A motion from the maneuver's joining on, as it will be heard, if it is certified.
  std::optional<CertifiedPart> promised(const Motion& motion, double follows_until_s,
                                        const Violation& cut_by) {
    const Motion part = rest_of(motion, motion.clean_cut(maneuver_.join_s));
    if (!fits(part)) return std::nullopt;
    const auto heard = as_heard(part);
    if (!heard) return std::nullopt;
    const auto driven = splice(start_.committed, start_.now_s, heard->start_time(), *heard);
    if (!driven || !in_reach(driven.motion)) return std::nullopt;
    if (violation_of(driven.motion, heard->start_time())) return std::nullopt;
    return CertifiedPart{*heard, follows_until_s, cut_by};
  }

  /// Farther, robots could be met that are not heard. What is committed may be driven to its end.
  bool in_reach(const Motion& driven) const {
    Eigen::AlignedBox2d box = rest_of(start_.committed, start_.now_s).box();
    box.extend(driven.box());
    return maneuver_.at_once || box.diagonal().norm() <= start_.promise_reach_m;
  }

  static std::optional<Motion> as_heard(const Motion& motion) {
    try {
      return quantised(motion);
    } catch (const std::invalid_argument&) {
      return std::nullopt;  // numbers that no message holds
    }
  }

  const ManeuverStart& start_;
  const Maneuver& maneuver_;
  const RequirementName required_;
  const Motion onward_;
};

}  // namespace

std::optional<CertifiedPart> certified_part(const ManeuverStart& start, const Maneuver& maneuver,
                                            RequirementName required) {
  auto onward = splice(start.committed, start.now_s, maneuver.join_s, maneuver.motion);
  if (!onward) return std::nullopt;
  return Cutter(start, maneuver, required, std::move(onward.motion)).longest();
}

}  // namespace mocha
