#include "planning/local/local_optimizer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planning/candidates/exposure.h"
#include "safety/certifier.h"
#include "safety/margin_budget.h"
#include "trajectory/splice.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kLatest = 1.6;      // times mu, after the least time: later, a drive is none
constexpr double kHeavier = 8.0;     // what is violated, in the second effort
constexpr int kEfforts = 2;          // of one optimisation
constexpr double kLeastShare = 0.5;  // of mu that is left for the drive after a turn in place

/// Time lost against the plan by a robot that is slower than the plan is there.
double catching_up_s(double speed, double plan_speed, double acceleration) {
  const double slower = plan_speed - std::clamp(speed, 0.0, plan_speed);
  return slower > 0.0 ? slower * slower / (2.0 * acceleration * plan_speed) : 0.0;
}

std::vector<Vector2> places_of(const TimedPath& path) {
  std::vector<Vector2> places;
  for (const TimedPoint& point : path) places.push_back(point.position);
  return places;
}

/// Whether heavier penalties may mend it: of 200 scenes' optimisations, none that missed by more
/// came out right.
bool is_nearly_kept(const Violation& violation) {
  constexpr double kLack_m = 0.2;
  constexpr double kExcess = 1.1;
  switch (violation.term) {
    case ViolatedTerm::kSeparation:
      return violation.limit - violation.value < kLack_m;
    case ViolatedTerm::kSpeed:
    case ViolatedTerm::kAcceleration:
      return violation.value < kExcess * violation.limit;
    default:
      return true;
  }
}

}  // namespace

LocalOptimizer::LocalOptimizer(const RobotModel& robot, const LocalOptions& options)
    : requirements_(robot),
      footprint_(robot.footprint),
      mu_s_(options.mu_s),
      weight_delay_(options.weight_delay),
      smooth_start_rad_(options.smooth_start_rad),
      optimizer_(robot, options, MarginBudget::of(robot).static_margin_m()) {}

Return LocalOptimizer::return_to(const RejoinPoint& rejoin_point, const LocalQuery& query) const {
  const double speed = query.committed.at(query.start_time_s).speed;
  const double plan_speed = query.plan.velocity(query.progress_s).norm();
  return {rejoin_point, rejoin_point.drive_s +
                            catching_up_s(speed, plan_speed, rest_acceleration(limits_of(query)))};
}

Violation LocalOptimizer::violation_of(const Motion& motion, const LocalScene& scene,
                                       RequirementName required, double from_s) const {
  return certify(motion, footprint_, scene, requirements_[required].from(from_s));
}

void LocalOptimizer::grade(const LocalQuery& query, const LocalScene& scene,
                           LocalCandidate& candidate) const {
  const auto violation = [&](RequirementName name) {
    const Requirement required =
        requirements_[name].from(query.start_time_s).until(candidate.rejoins_s);
    return certify(candidate.motion, footprint_, scene, required);
  };
  candidate.violation = violation(query.wanted);
  if (!candidate.violation) {
    candidate.met = query.wanted;
    return;
  }
  for (const RequirementName name :
       {RequirementName::kDetourLikely, RequirementName::kEmergencyDetour}) {
    if (name <= query.wanted || violation(name)) continue;
    candidate.met = name;
    return;
  }
  candidate.met = RequirementName::kNone;
}

void LocalOptimizer::drive(const LocalQuery& query, const LocalScene& scene, const Return& back,
                           const StartManeuver& start_maneuver, LocalCandidate& candidate) const {
  DriveQuery drive;
  drive.path = start_maneuver.path;
  drive.start = start_maneuver.state;
  drive.start_time_s = query.start_time_s + start_maneuver.duration_s;
  drive.limits = limits_of(query);
  drive.moving = foreseen(kept_apart(scene, requirements_[query.wanted].from(query.start_time_s)));
  for (const TimedPoint& point : candidate.path)
    drive.times_s.push_back(point.time_s - query.start_time_s);
  const double mu_s = back.earliest_s - start_maneuver.duration_s;
  drive.rejoin = back.rejoin_point.state;
  drive.duration_cost =
      DurationCost::with_horizon(weight_delay_, std::max(kLeastShare * back.earliest_s, mu_s));
  Effort effort;
  for (int i = 0; i < kEfforts; ++i) {
    const auto found =
        optimizer_.optimize_drive(drive, scene.static_map->field(), effort, [] { return false; });
    if (found.curve.pieces() == 0) return;
    std::vector<Phase> phases = start_maneuver.phases;
    phases.emplace_back(DrivePhase{1, found.curve});
    LocalCandidate tried = candidate;
    tried.terms = found.terms;
    tried.cost = found.cost;
    tried.rejoins_s = drive.start_time_s + found.curve.duration();
    auto motion =
        splice(query.start_time_s, std::move(phases), query.plan, back.rejoin_point.plan_time_s);
    if (!motion) return;  // what the optimiser found is none
    tried.motion = std::move(motion.motion);
    grade(query, scene, tried);
    const double late_s = tried.rejoins_s - query.start_time_s - back.earliest_s;
    if (late_s > kLatest * mu_s_) return;  // to brake and wait is better
    const Violation violation = tried.violation;
    if (tried.met <= candidate.met) candidate = std::move(tried);
    if (candidate.met == query.wanted || !is_nearly_kept(violation)) return;
    effort = raised(effort, violation, kHeavier);
  }
}

std::vector<StartManeuver> LocalOptimizer::start_maneuvers(const LocalQuery& query,
                                                           std::vector<Vector2> path) const {
  const MotionState start = query.committed.at(query.start_time_s);
  const MotionLimits& limits = limits_of(query);
  const StartManeuvers start_maneuvers(limits, smooth_start_rad_, rest_acceleration(limits));
  if (start.at_rest) return start_maneuvers.from_rest({}, start.pose, path);
  std::vector<StartManeuver> rolling = start_maneuvers.rolling(start, path);
  if (!rolling.empty()) return rolling;
  const std::vector<Phase> brake =
      brake_along(query.committed, query.start_time_s, rest_acceleration(limits));
  const Pose stop = Motion(query.start_time_s, brake).end_pose();
  path.front() = stop.position;
  return start_maneuvers.from_rest(brake, stop, path);
}

LocalCandidate LocalOptimizer::optimize(const LocalQuery& query, const LocalScene& scene,
                                        const Return& back, const SpaceTimePath& path) const {
  LocalCandidate candidate;
  candidate.path = path.points;
  candidate.signature = path.signature;
  candidate.driven = path.driven;
  for (const StartManeuver& start_maneuver : start_maneuvers(query, places_of(path.points))) {
    drive(query, scene, back, start_maneuver, candidate);
    if (candidate.met == query.wanted) break;
  }
  return candidate;
}

}  // namespace mocha
