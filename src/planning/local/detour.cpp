#include "planning/local/detour.h"

namespace mocha {
namespace {

constexpr double kOffPlan_m = 1.5;        // farther from the plan, it is not come back to
constexpr double kAgain_s = 0.19;         // between two detours
constexpr double kAfterFailure_s = 0.39;  // where there was no path just now
constexpr double kSoonerEvery_s = 0.5;    // people move on
constexpr double kMuchSooner_s = 1.0;     // kSoonerArrival_s for a change of class

bool is_on(const Motion& plan, const RejoinPoint& rejoin_point) {
  constexpr double kSamePlace_m = 1e-3;
  return (plan.position(rejoin_point.plan_time_s) - rejoin_point.place()).norm() < kSamePlace_m;
}

/// The plan; where the robot does not keep its times, as after braking, from the nearest place on.
Motion driven_on(const Detour::Start& at) {
  if (at.follows_plan || at.plan.empty()) return at.plan;
  const Vector2 place = at.committed.position(at.join_s);
  const auto progress_s = progress_on(at.plan, place, at.plan.start_time(), kOffPlan_m);
  if (!progress_s) return Motion();
  return Motion(at.plan.start_time() + at.join_s - *progress_s, at.plan.phases());
}

}  // namespace

Detour::Detour(const RobotModel& robot, const LocalOptions& options,
               const LocalPlanner::Watch& watch)
    : planner_(robot, options, watch) {}

std::optional<LocalQuery> Detour::way_back(const Start& at) const {
  LocalQuery query;
  query.committed = at.committed;
  query.start_time_s = at.join_s;
  query.driven = driven_on(at);
  const Vector2 place = at.committed.position(at.join_s);
  for (const Motion* plan : {&route_, &at.plan}) {
    if (plan->empty()) continue;
    const auto progress_s = plan == &at.plan && at.follows_plan
                                ? at.join_s
                                : progress_on(*plan, place, plan->start_time(), kOffPlan_m);
    if (!progress_s) continue;
    query.plan = *plan;
    if (plan == &route_) query.rejoin_point_s = rejoin_point_s_;
    query.progress_s = *progress_s;
    return query;
  }
  return std::nullopt;
}

std::optional<LocalPlan> Detour::around(const Start& at, const LocalScene& scene) {
  if (at.plan.empty() || at.now_s < not_before_s_) return std::nullopt;
  tried_s_ = at.now_s;
  not_before_s_ = at.now_s + kAfterFailure_s;
  const auto query = way_back(at);
  if (!query) return std::nullopt;
  return planner_.plan(*query, scene);
}

LocalPlan Detour::harder(const Start& at, const LocalScene& scene, const LocalPlan& failed) const {
  auto query = way_back(at);
  if (!query) return failed;
  query->wanted = RequirementName::kEmergencyDetour;
  return planner_.again(*query, scene, failed);
}

std::optional<LocalPlan> Detour::sooner(const Start& at, const LocalScene& scene) {
  const bool on_the_way = !route_.empty() && at.now_s < rejoins_s_ && at.follows_plan;
  if (!on_the_way || at.now_s < tried_s_ + kSoonerEvery_s) return std::nullopt;
  tried_s_ = at.now_s;
  const auto query = way_back(at);
  if (!query) return std::nullopt;
  const auto gains = [&](const LocalPlan& local, double by_s) {
    return local.met == query->wanted && local.motion.end_time() < at.plan.end_time() - by_s;
  };
  LocalPlan kept = planner_.keep_on(*query, scene);
  if (gains(kept, kSoonerArrival_s)) return kept;
  LocalPlan other = planner_.anew(*query, scene);
  if (gains(other, other.switches_class ? kMuchSooner_s : kSoonerArrival_s)) return other;
  return std::nullopt;
}

void Detour::take(double now_s, const Motion& left, const LocalPlan& taken) {
  if (route_.empty()) route_ = left;
  rejoins_s_ = taken.rejoins_s;
  rejoin_point_s_ = is_on(route_, taken.rejoin_point) ? taken.rejoin_point.plan_time_s : 0.0;
  not_before_s_ = now_s + kAgain_s;
}

}  // namespace mocha
