#include "planning/promise_builder.h"

#include <algorithm>
#include <utility>

#include "fleet/wire_format.h"
#include "planning/escape_proof.h"
#include "planning/peer_discs.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.1;        // between the places where braking is tried
constexpr double kPeerSlack_m = 0.01;  // so that a proof today still holds tomorrow
constexpr double kShareInForce = 0.7;  // of the clearance to people
// What is promised now holds for predictions that reach farther, so that it need not be replaced as
// soon as they do.
constexpr double kReserve_s = 1.0;
constexpr double kPeerHorizon_s = 10.0;  // of predictions that never come to rest

}  // namespace

Motion remainder(const Motion& motion, double from_s) {
  from_s = std::max(from_s, motion.start_time());
  std::vector<Phase> phases = motion.phases_between(from_s, motion.end_time());
  if (phases.empty()) phases.emplace_back(StandPhase{motion.end_pose(), kStep_s});
  return Motion(from_s, std::move(phases));
}

Motion continued(const Motion& committed, double now_s, double join_s, const Motion& next) {
  const double begin_s = std::max(committed.cut_time(now_s), committed.start_time());
  std::vector<Phase> phases = committed.phases_between(begin_s, join_s);
  const double stands_from_s = std::max(begin_s, committed.end_time());
  if (stands_from_s < join_s)
    phases.emplace_back(StandPhase{committed.end_pose(), join_s - stands_from_s});
  for (const Phase& phase : next.phases()) phases.push_back(phase);
  return Motion(begin_s, std::move(phases));
}

PromiseScene PromiseScene::most_likely() const {
  PromiseScene scene = *this;
  if (!expected.empty()) scene.moving.swap(scene.expected);
  scene.expected.clear();
  return scene;
}

PromiseBuilder::PromiseBuilder(RobotModel robot)
    : robot_(std::move(robot)), margins_(MarginBudget::of(robot_)) {}

Violation PromiseBuilder::certify(const Motion& motion, const PromiseScene& scene,
                                  double from_s) const {
  return check(motion, scene, from_s, {margins_.static_margin_m(), kPeerSlack_m, 1.0, 0.0});
}

Violation PromiseBuilder::certify_in_force(const Motion& motion, const PromiseScene& scene,
                                           double from_s) const {
  // The peers' broadcasters settle with exactly the required distance.
  return check(
      motion, scene.most_likely(), from_s,
      {margins_.static_margin_m() - margins_.map_m, -kPeerSlack_m, kShareInForce, kReserve_s});
}

double PromiseBuilder::hard_deceleration() const {
  return std::max(deceleration(), 0.6 * robot_.max_wheel_acceleration);
}

double PromiseBuilder::stop_deceleration(const UnicycleState& twist) const {
  const WheelSpeeds wheels = wheel_speeds(twist, robot_.limits.track_m);
  const double fastest = std::max(std::abs(wheels.left), std::abs(wheels.right));
  const double share = fastest > 0.0 ? std::abs(twist.speed) / fastest : 1.0;
  return std::max(deceleration(), share * robot_.max_wheel_acceleration);
}

std::vector<MovingThing> PromiseBuilder::kept_from(const PromiseScene& scene, double now_s,
                                                   double share) const {
  return kept_from(scene, now_s, Kept{0.0, kPeerSlack_m, share, 0.0});
}

std::vector<MovingThing> PromiseBuilder::kept_from(const PromiseScene& scene, double now_s,
                                                   const Kept& kept) const {
  std::vector<MovingThing> things;
  const double from_peers_m = distance_to_peers_m(robot_) + kept.peer_slack_m;
  for (const auto& peer : scene.others)
    things.push_back({peer, from_peers_m, now_s + kPeerHorizon_s});
  const double from_moving_m = robot_.footprint.circumscribed_radius_m() + margins_.own_margin_m() +
                               kept.moving_share * robot_.moving_clearance_m;
  for (const auto& thing : scene.moving)
    things.push_back({thing, from_moving_m, scene.predicted_until_s - kept.reserve_s});
  return things;
}

Violation PromiseBuilder::check(const Motion& motion, const PromiseScene& scene, double from_s,
                                const Kept& kept) const {
  Violation first = check_clearance_or_leaving(motion, robot_.footprint, *scene.obstacles,
                                               kept.obstacles_m, from_s);
  const auto keep_earlier = [&first](const Violation& other) {
    if (other && (!first || other.time_s < first.time_s)) first = other;
  };
  Violation unseen =
      check_clearance_or_leaving(motion, robot_.footprint, *scene.unseen, 0.0, from_s);
  if (unseen) unseen.term = ViolatedTerm::kUnseenSpace;
  keep_earlier(unseen);
  const double radius_m = robot_.footprint.circumscribed_radius_m();
  for (const MovingThing& thing : kept_from(scene, from_s, kept)) {
    if (thing.until_s <= from_s) continue;
    keep_earlier(check_separation_or_leaving(motion, radius_m, *thing.obstacle,
                                             thing.keep_m - radius_m, from_s, thing.until_s));
  }
  return first;
}

std::optional<CertifiedMotion> PromiseBuilder::longest(const Motion& motion,
                                                       const PromiseScene& scene, double from_s,
                                                       double earliest_s, double latest_s) const {
  const Violation obstacle = certify(motion, scene, from_s);
  const double begin_s = motion.clean_cut(motion.cut_time(from_s));
  double brake_s = latest_s;
  if (motion.end_time() <= latest_s) {
    const Motion whole = remainder(motion, begin_s);
    if (!obstacle && fits(whole)) return CertifiedMotion{whole, motion.end_time(), {}};
    brake_s = motion.end_time();
  }
  const auto braking_at = [&](double t) -> std::optional<CertifiedMotion> {
    const Motion cut = with_brake(motion, begin_s, t, deceleration());
    if (certify(cut, scene, from_s) || !fits(cut)) return std::nullopt;
    return CertifiedMotion{cut, t, obstacle};
  };
  if (obstacle) brake_s = std::min(brake_s, obstacle.time_s);
  brake_s = std::max(brake_s, earliest_s);
  if (auto found = braking_at(brake_s)) return found;
  // Who drives before somebody may be in his way when he stops, and not before.
  const double last_s = obstacle ? brake_s : std::min(scene.predicted_until_s, motion.end_time());
  for (double t = brake_s + kStep_s; t < last_s; t += kStep_s) {
    if (auto found = braking_at(t)) return found;
  }
  while (brake_s > earliest_s) {
    brake_s = std::max(brake_s - kStep_s, earliest_s);
    if (auto found = braking_at(brake_s)) return found;
  }
  return std::nullopt;
}

}  // namespace mocha
