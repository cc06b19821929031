#include "planning/local/local_rules.h"

#include <algorithm>
#include <utility>

#include "planning/candidates/exposure.h"
#include "safety/certifier.h"
#include "trajectory/splice.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

/// Time lost against the plan by a robot that is slower than the plan is there.
double catching_up_s(double speed, double plan_speed, double acceleration) {
  const double slower = plan_speed - std::clamp(speed, 0.0, plan_speed);
  return slower > 0.0 ? slower * slower / (2.0 * acceleration * plan_speed) : 0.0;
}

std::vector<StartManeuver> start_maneuvers_on(std::vector<Vector2> path, const LocalQuery& query,
                                              const MotionLimits& limits, double smooth_start_rad) {
  const MotionState start = query.committed.at(query.start_time_s);
  const StartManeuvers start_maneuvers(limits, smooth_start_rad);
  if (start.at_rest) return start_maneuvers.from_rest({}, start.pose, path);
  std::vector<StartManeuver> rolling = start_maneuvers.rolling(start, path);
  if (!rolling.empty()) return rolling;
  const std::vector<Phase> brake =
      brake_along(query.committed, query.start_time_s, Braking(rest_acceleration(limits)));
  const Pose stop = Motion(query.start_time_s, brake).end_pose();
  path.front() = stop.position;
  return start_maneuvers.from_rest(brake, stop, path);
}

}  // namespace

Return return_to(const RejoinPoint& rejoin_point, const LocalQuery& query,
                 const MotionLimits& limits) {
  const double speed = query.committed.at(query.start_time_s).speed;
  const double plan_speed = query.plan.velocity(query.progress_s).norm();
  return {rejoin_point,
          rejoin_point.drive_s + catching_up_s(speed, plan_speed, rest_acceleration(limits))};
}

Seed seed_of(const SpaceTimePath& path, const LocalQuery& query, const MotionLimits& limits,
             double smooth_start_rad) {
  constexpr double kLeastCost = 0.0;  // more is not known
  std::vector<Vector2> places;
  std::vector<double> times_s;
  for (const TimedPoint& point : path.points) {
    places.push_back(point.position);
    times_s.push_back(point.time_s - query.start_time_s);
  }
  return {start_maneuvers_on(std::move(places), query, limits, smooth_start_rad),
          std::move(times_s), path.signature, kLeastCost, path.driven};
}

EffortLadder LocalRules::ladder() const {
  constexpr int kAttempts = 2;
  constexpr double kFactor = 8.0;
  return {kAttempts, kFactor};
}

DriveQuery LocalRules::drive(const Seed& seed, const StartManeuver& start_maneuver) const {
  constexpr double kLeastShare = 0.5;  // of mu that is left for the drive after a turn in place
  const Requirement required = requirements_[query_.wanted].from(query_.start_time_s);
  const double mu_s =
      std::max(kLeastShare * back_.earliest_s, back_.earliest_s - start_maneuver.duration_s);
  DriveQuery drive;
  drive.path = start_maneuver.path;
  drive.start = start_maneuver.state;
  drive.start_time_s = query_.start_time_s + start_maneuver.duration_s;
  drive.moving = foreseen(kept_apart(scene_, required));
  drive.times_s = seed.times_s;
  drive.rejoin = back_.rejoin_point.state;
  drive.duration_cost = DurationCost::with_horizon(options_.weight_delay, mu_s);
  drive.limits = required.limits;
  drive.speed_zones = scene_.speed_zones;
  return drive;
}

bool LocalRules::assemble(const StartManeuver& start_maneuver, const PlanarPath& drive,
                          PlanCandidate& candidate) const {
  constexpr double kLatest = 1.6;  // times mu, after the least time: to brake and wait is better
  const double took_s = start_maneuver.duration_s + drive.duration();
  if (took_s - back_.earliest_s > kLatest * options_.mu_s) return false;
  std::vector<Phase> phases = start_maneuver.phases;
  phases.emplace_back(DrivePhase{1, drive});
  MotionOrFault motion =
      splice(query_.start_time_s, std::move(phases), query_.plan, back_.rejoin_point.plan_time_s);
  if (!motion) return false;
  candidate.motion = std::move(motion.motion);
  candidate.drive_ends_s = query_.start_time_s + took_s;
  return true;
}

void LocalRules::certify(PlanCandidate& candidate) const {
  const auto violation = [&](RequirementName name) {
    const Requirement required =
        requirements_[name].from(query_.start_time_s).until(candidate.drive_ends_s);
    return mocha::certify(candidate.motion, footprint_, scene_, required);
  };
  candidate.violation = violation(query_.wanted);
  candidate.met = candidate.violation ? RequirementName::kNone : query_.wanted;
  for (const RequirementName lesser :
       {RequirementName::kDetourLikely, RequirementName::kEmergencyDetour}) {
    if (candidate.met != RequirementName::kNone || lesser <= query_.wanted) continue;
    if (!violation(lesser)) candidate.met = lesser;
  }
}

bool LocalRules::may_be_mended(const Violation& violation) const {
  // Of 200 scenes' optimisations, none that missed by more came out right.
  constexpr double kLack_m = 0.2;
  constexpr double kExcess = 1.1;
  switch (violation.term) {
    case ViolatedTerm::kSeparation:
      return violation.limit - violation.value < kLack_m;
    case ViolatedTerm::kSpeed:
    case ViolatedTerm::kZoneSpeed:
    case ViolatedTerm::kAcceleration:
      return violation.value < kExcess * violation.limit;
    default:
      return true;
  }
}

}  // namespace mocha
