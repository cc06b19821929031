#include "planning/swerving.h"

#include <algorithm>
#include <memory>

#include "planning/way_out.h"
#include "topology/map_terrain.h"

namespace mocha {
namespace {

constexpr double kOffPlan_m = 1.5;        // farther from the plan, it is not come back to
constexpr double kAgain_s = 0.19;         // between two swerves
constexpr double kAfterFailure_s = 0.39;  // where there was no way just now
constexpr double kSoonerEvery_s = 0.5;    // people move on
constexpr double kSooner_s = 0.2;         // to arrive by less is not worth a change
constexpr double kMuchSooner_s = 1.0;     // nor, by less, one of class

bool is_on(const Motion& plan, const RejoiningPoint& anchor) {
  constexpr double kSamePlace_m = 1e-3;
  return (plan.position(anchor.plan_time_s) - anchor.place()).norm() < kSamePlace_m;
}

/// The plan; where the robot does not keep its times, as after braking, from the nearest place on.
Motion driven_on(const Swerving::Situation& at) {
  if (at.follows_plan || at.plan.empty()) return at.plan;
  const Vector2 place = at.committed.position(at.join_s);
  const auto progress_s = progress_on(at.plan, place, at.plan.start_time(), kOffPlan_m);
  if (!progress_s) return Motion();
  return Motion(at.plan.start_time() + at.join_s - *progress_s, at.plan.phases());
}

}  // namespace

Swerving::Swerving(const RobotModel& robot, const LocalRules& rules,
                   const LocalPlanner::Watch& watch)
    : builder_(robot),
      planner_(robot, rules, watch),
      hard_planner_(WayOut::hardened(robot), rules, watch) {}

std::optional<LocalQuery> Swerving::way_back(const Situation& at) const {
  LocalQuery query{at.committed, at.join_s, {}, 0.0, driven_on(at)};
  const Vector2 place = at.committed.position(at.join_s);
  for (const Motion* plan : {&route_, &at.plan}) {
    if (plan->empty()) continue;
    const auto progress_s = plan == &at.plan && at.follows_plan
                                ? at.join_s
                                : progress_on(*plan, place, plan->start_time(), kOffPlan_m);
    if (!progress_s) continue;
    query.plan = *plan;
    if (plan == &route_) query.anchor_s = anchor_s_;
    query.progress_s = *progress_s;
    return query;
  }
  return std::nullopt;
}

LocalScene Swerving::local(double now_s, const PromiseScene& scene) const {
  LocalScene local{
      std::make_shared<MapTerrain>(scene.obstacles), builder_.kept_from(scene, now_s, 1.0), {}};
  if (!scene.expected.empty()) local.expected = builder_.kept_from(scene.most_likely(), now_s, 1.0);
  return local;
}

std::optional<LocalPlan> Swerving::around(const Situation& at, const PromiseScene& scene) {
  if (at.plan.empty() || at.now_s < not_before_s_) return std::nullopt;
  tried_s_ = at.now_s;
  not_before_s_ = at.now_s + kAfterFailure_s;
  const auto query = way_back(at);
  if (!query) return std::nullopt;
  return planner_.plan(*query, local(at.now_s, scene));
}

LocalPlan Swerving::harder(const Situation& at, const PromiseScene& scene,
                           const LocalPlan& failed) const {
  const auto query = way_back(at);
  if (!query) return failed;
  LocalPlan plan = hard_planner_.again(*query, local(at.now_s, scene.most_likely()), failed);
  plan.proof = std::max(plan.proof, LocalProof::kEmergency);
  return plan;
}

std::optional<LocalPlan> Swerving::sooner(const Situation& at, const PromiseScene& scene) {
  const bool on_the_way = !route_.empty() && at.now_s < rejoins_s_ && at.follows_plan;
  if (!on_the_way || at.now_s < tried_s_ + kSoonerEvery_s) return std::nullopt;
  tried_s_ = at.now_s;
  const auto query = way_back(at);
  if (!query) return std::nullopt;
  const LocalScene around = local(at.now_s, scene);
  const auto gains = [&at](const LocalPlan& local, double by_s) {
    return local.proof == LocalProof::kAsked && local.motion.end_time() < at.plan.end_time() - by_s;
  };
  LocalPlan kept = planner_.keep_on(*query, around);
  if (gains(kept, kSooner_s)) return kept;
  LocalPlan other = planner_.anew(*query, around);
  if (gains(other, other.switches_class ? kMuchSooner_s : kSooner_s)) return other;
  return std::nullopt;
}

void Swerving::take(double now_s, const Motion& left, const LocalPlan& taken) {
  if (route_.empty()) route_ = left;
  rejoins_s_ = taken.rejoins_s;
  anchor_s_ = is_on(route_, taken.anchor) ? taken.anchor.plan_time_s : 0.0;
  not_before_s_ = now_s + kAgain_s;
}

}  // namespace mocha
