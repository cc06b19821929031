#include "planning/local_optimizer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "planning/conflict.h"
#include "planning/escape_proof.h"
#include "planning/way_out.h"
#include "safety/margin_budget.h"
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

std::vector<Vector2> places_of(const TimedPath& way) {
  std::vector<Vector2> places;
  for (const TimedPoint& point : way) places.push_back(point.position);
  return places;
}

const Violation& earlier(const Violation& a, const Violation& b) {
  return !b || (a && a.time_s <= b.time_s) ? a : b;
}

const std::vector<MovingThing>& likely(const LocalScene& scene) {
  return scene.expected.empty() ? scene.moving : scene.expected;
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

LocalOptimizer::LocalOptimizer(const RobotModel& robot, const LocalRules& rules)
    : robot_(robot),
      emergency_limits_(WayOut::hardened(robot).limits),
      mu_s_(rules.mu_s),
      margin_m_(MarginBudget::of(robot).static_margin_m()),
      optimizer_(robot, rules, margin_m_),
      openings_(robot.limits, rules.smooth_start_rad, optimizer_.rest_acceleration()) {}

Return LocalOptimizer::return_to(const RejoiningPoint& anchor, const LocalQuery& query) const {
  const double speed = query.committed.at(query.start_time_s).speed;
  const double plan_speed = query.plan.velocity(query.progress_s).norm();
  return {anchor,
          anchor.drive_s + catching_up_s(speed, plan_speed, optimizer_.rest_acceleration())};
}

Violation LocalOptimizer::violation_of(const Motion& motion, const LocalScene& scene,
                                       double from_s) const {
  return earlier(earlier(check_limits(motion, robot_.limits, from_s),
                         check_clearance_or_leaving(motion, robot_.footprint,
                                                    scene.terrain->field(), margin_m_, from_s)),
                 certify(motion, scene.moving, from_s));
}

Violation LocalOptimizer::certify(const Motion& motion, const std::vector<MovingThing>& moving,
                                  double from_s) const {
  Violation first;
  const double radius_m = robot_.footprint.circumscribed_radius_m();
  for (const MovingThing& thing : moving) {
    if (thing.until_s <= from_s) continue;
    first =
        earlier(first, check_separation_or_leaving(motion, radius_m, *thing.obstacle,
                                                   thing.keep_m - radius_m, from_s, thing.until_s));
  }
  return first;
}

LocalProof LocalOptimizer::proof_of(const Motion& motion, const LocalScene& scene, double from_s,
                                    double until_s, Violation& violation) const {
  const auto kept = [until_s](const Violation& each) { return !each || each.time_s >= until_s; };
  const Violation limits = check_limits(motion, robot_.limits, from_s);
  const Violation still = check_clearance_or_leaving(motion, robot_.footprint,
                                                     scene.terrain->field(), margin_m_, from_s);
  violation = earlier(earlier(limits, still), certify(motion, scene.moving, from_s));
  if (kept(violation)) return LocalProof::kAsked;
  if (!kept(still) || !kept(certify(motion, likely(scene), from_s))) return LocalProof::kNone;
  if (kept(limits)) return LocalProof::kLikely;
  return kept(check_limits(motion, emergency_limits_, from_s)) ? LocalProof::kEmergency
                                                               : LocalProof::kNone;
}

void LocalOptimizer::drive(const LocalQuery& query, const LocalScene& scene, const Return& back,
                           const Opening& opening, LocalCandidate& candidate) const {
  DriveQuery drive;
  drive.path = opening.path;
  drive.start = opening.state;
  drive.start_time_s = query.start_time_s + opening.duration_s;
  drive.moving = foreseen(scene.moving);
  for (const TimedPoint& point : candidate.way)
    drive.times_s.push_back(point.time_s - query.start_time_s);
  const double mu_s = back.earliest_s - opening.duration_s;
  drive.anchor = Anchor{back.anchor.state, std::max(kLeastShare * back.earliest_s, mu_s)};
  Effort effort;
  for (int i = 0; i < kEfforts; ++i) {
    const auto found =
        optimizer_.optimize_drive(drive, scene.terrain->field(), effort, [] { return false; });
    if (found.curve.pieces() == 0) return;
    std::vector<Phase> phases = opening.phases;
    phases.emplace_back(DrivePhase{1, found.curve});
    LocalCandidate tried = candidate;
    tried.terms = found.terms;
    tried.cost = found.cost;
    tried.rejoins_s = drive.start_time_s + found.curve.duration();
    tried.motion = rejoined(query.start_time_s, std::move(phases), query.plan, back.anchor);
    tried.proof =
        proof_of(tried.motion, scene, query.start_time_s, tried.rejoins_s, tried.violation);
    const double late_s = tried.rejoins_s - query.start_time_s - back.earliest_s;
    if (late_s > kLatest * mu_s_) return;  // to brake and wait is better
    const Violation violation = tried.violation;
    if (tried.proof <= candidate.proof) candidate = std::move(tried);
    if (candidate.proof == LocalProof::kAsked || !is_nearly_kept(violation)) return;
    effort = raised(effort, violation, kHeavier);
  }
}

std::vector<Opening> LocalOptimizer::openings(const LocalQuery& query,
                                              std::vector<Vector2> path) const {
  const MotionState start = query.committed.at(query.start_time_s);
  if (start.at_rest) return openings_.from_rest({}, start.pose, path);
  std::vector<Opening> rolling = openings_.rolling(start, path);
  if (!rolling.empty()) return rolling;
  const std::vector<Phase> brake =
      brake_along(query.committed, query.start_time_s, optimizer_.rest_acceleration());
  const Pose stop = Motion(query.start_time_s, brake).end_pose();
  path.front() = stop.position;
  return openings_.from_rest(brake, stop, path);
}

LocalCandidate LocalOptimizer::optimize(const LocalQuery& query, const LocalScene& scene,
                                        const Return& back, const SpaceTimeWay& way) const {
  LocalCandidate candidate;
  candidate.way = way.points;
  candidate.signature = way.signature;
  candidate.driven = way.driven;
  for (const Opening& opening : openings(query, places_of(way.points))) {
    try {
      drive(query, scene, back, opening, candidate);
    } catch (const std::invalid_argument&) {
      continue;  // what the optimiser found is no motion
    }
    if (candidate.proof == LocalProof::kAsked) break;
  }
  return candidate;
}

}  // namespace mocha
