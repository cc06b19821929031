#include "planning/promise_builder.h"

#include <algorithm>
#include <utility>

#include "planning/escape_proof.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.1;          // between the places where braking is tried
constexpr double kPeerSlack_m = 0.01;    // so that a proof today still holds tomorrow
constexpr double kPeerHorizon_s = 10.0;  // of predictions that never come to rest

}  // namespace

Motion remainder(const Motion& motion, double from_s) {
  from_s = std::max(from_s, motion.start_time());
  std::vector<Phase> phases = motion.phases_between(from_s, motion.end_time());
  if (phases.empty()) phases.emplace_back(StandPhase{motion.end_pose(), kStep_s});
  return Motion(from_s, std::move(phases));
}

PromiseBuilder::PromiseBuilder(RobotModel robot)
    : robot_(std::move(robot)), margins_(MarginBudget::of(robot_)) {}

Violation PromiseBuilder::certify(const Motion& motion, const PromiseScene& scene,
                                  double from_s) const {
  const double apart_m = robot_.peer_clearance_m + margins_.peer_margin_m();
  return check(motion, scene, from_s, {margins_.static_margin_m(), apart_m + kPeerSlack_m});
}

Violation PromiseBuilder::certify_in_force(const Motion& motion, const PromiseScene& scene,
                                           double from_s) const {
  // The peers' broadcasters settle with exactly the required distance.
  const double apart_m = robot_.peer_clearance_m + margins_.peer_margin_m();
  return check(motion, scene, from_s,
               {margins_.static_margin_m() - margins_.map_m, apart_m - kPeerSlack_m});
}

Violation PromiseBuilder::check(const Motion& motion, const PromiseScene& scene, double from_s,
                                const Margins& margins) const {
  Violation first = check_clearance_or_leaving(motion, robot_.footprint, *scene.obstacles,
                                               margins.obstacles_m, from_s);
  const auto keep_earlier = [&first](const Violation& other) {
    if (other && (!first || other.time_s < first.time_s)) first = other;
  };
  Violation unseen =
      check_clearance_or_leaving(motion, robot_.footprint, *scene.unseen, 0.0, from_s);
  if (unseen) unseen.term = ViolatedTerm::kUnseenSpace;
  keep_earlier(unseen);
  for (const auto& other : scene.others) {
    keep_earlier(check_separation_or_leaving(motion, robot_.footprint.circumscribed_radius_m(),
                                             *other, margins.others_m, from_s,
                                             from_s + kPeerHorizon_s));
  }
  return first;
}

std::optional<CertifiedMotion> PromiseBuilder::longest(const Motion& motion,
                                                       const PromiseScene& scene, double from_s,
                                                       double earliest_s, double latest_s) const {
  const Violation obstacle = certify(motion, scene, from_s);
  const double begin_s = motion.cut_time(from_s);
  double brake_s = latest_s;
  if (motion.end_time() <= latest_s) {
    const Motion whole = remainder(motion, begin_s);
    if (!obstacle) return CertifiedMotion{whole, motion.end_time(), {}};
    brake_s = motion.end_time();
  }
  if (obstacle) brake_s = std::min(brake_s, obstacle.time_s);
  for (;; brake_s -= kStep_s) {
    brake_s = std::max(brake_s, earliest_s);
    const Motion cut = with_brake(motion, begin_s, brake_s, deceleration());
    if (!certify(cut, scene, from_s)) return CertifiedMotion{cut, brake_s, obstacle};
    if (brake_s <= earliest_s) return std::nullopt;
  }
}

}  // namespace mocha
