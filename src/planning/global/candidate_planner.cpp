#include "planning/global/candidate_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planning/candidates/peer_discs.h"
#include "safety/certifier.h"
#include "safety/margin_budget.h"

namespace mocha {
namespace {

constexpr int kAttempts = 8;          // of one optimisation, each with more effort
constexpr double kSlowest = 4.0;      // times as long as optimised: slower motions are none
constexpr double kRepairable = 1.03;  // not worth another optimisation
constexpr double kSlowDownSlack = 1.001;

/// How many times as long a motion must take to keep the limit that it violates; 1 where that does
/// not help.
double slow_down(const Violation& violation) {
  const double excess = kSlowDownSlack * violation.value / violation.limit;
  switch (violation.term) {
    case ViolatedTerm::kSpeed:
    case ViolatedTerm::kYawRate:
    case ViolatedTerm::kWheelSpeed:
      return excess;
    case ViolatedTerm::kAcceleration:
      return std::sqrt(excess);
    default:
      return 1.0;
  }
}

/// The shortest time in which a length can be driven from `speed` to rest, straight.
double least_duration_s(double length_m, double speed, const MotionLimits& limits) {
  const double a = limits.max_acceleration;
  const double v = std::min(limits.max_speed, std::sqrt(a * length_m + 0.5 * speed * speed));
  if (v <= speed) return length_m / std::max(speed, limits.max_speed);
  const double ramps_m = (2.0 * v * v - speed * speed) / (2.0 * a);
  return (2.0 * v - speed) / a + std::max(0.0, length_m - ramps_m) / v;
}

}  // namespace

CandidatePlanner::CandidatePlanner(const RobotModel& robot, const PlannerOptions& options)
    : robot_(robot),
      options_(options),
      requirements_(robot),
      optimizer_(robot, options, MarginBudget::of(robot).static_margin_m()),
      front_end_(robot, options, optimizer_.rest_acceleration()) {}

Violation CandidatePlanner::certify(const Motion& motion, const ObstacleField<2>& obstacles,
                                    double from_s) const {
  Scene scene;
  scene.obstacles = std::shared_ptr<const ObstacleField<2>>(&obstacles, [](const auto*) {});
  return mocha::certify(motion, robot_.footprint, scene,
                        requirements_[RequirementName::kPlan].from(from_s));
}

double CandidatePlanner::least_cost(const CandidateSeed& seed) const {
  double least_s = std::numeric_limits<double>::infinity();
  for (const StartManeuver& start_maneuver : seed.start_maneuvers) {
    const double speed = start_maneuver.state.col(1).norm();
    least_s = std::min(least_s, start_maneuver.duration_s +
                                    least_duration_s(seed.least_length_m, speed, robot_.limits));
  }
  return options_.weight_duration * least_s;
}

MotionOrFault CandidatePlanner::assemble(const PlanQuery& query,
                                         const StartManeuver& start_maneuver,
                                         PlanarPath curve) const {
  std::vector<Phase> phases = start_maneuver.phases;
  const DrivePhase drive{1, std::move(curve)};
  phases.emplace_back(drive);
  if (query.goal_yaw_rad) {
    const double end_s = drive.path.duration();
    const Pose end{drive.path.position(end_s), heading(drive, end_s)};
    const double change = wrap_angle(*query.goal_yaw_rad - end.yaw_rad);
    if (const auto turn = front_end_.start_maneuvers().turn(end, change))
      phases.emplace_back(*turn);
  }
  return Motion::make(query.start_time_s, std::move(phases));
}

void CandidatePlanner::prove(const PlanQuery& query, MotionOrFault motion,
                             const ObstacleField<2>& obstacles, PlanCandidate& candidate) const {
  candidate.violation = {};
  candidate.motion = std::move(motion.motion);
  if (motion) candidate.violation = certify(candidate.motion, obstacles, query.start_time_s);
}

void CandidatePlanner::drive(const PlanQuery& query, const StartManeuver& start_maneuver,
                             const PlanningScene& scene, const std::function<bool()>& should_stop,
                             PlanCandidate& candidate) const {
  const ObstacleField<2>& obstacles = scene.static_map->field();
  DriveQuery drive;
  drive.path = start_maneuver.path;
  drive.start = start_maneuver.state;
  drive.start_time_s = query.start_time_s + start_maneuver.duration_s;
  for (const auto& peer : scene.peers) {
    const bool standing = stands(*peer, query.start_time_s);
    const BlockedDisc disc = peer_keep_out(*peer, query.start_time_s, robot_, 0.0);
    // A team-mate that stands on the goal will hardly stay: drive up, and let the promises keep
    // apart.
    if (standing && (disc.centre - start_maneuver.path.back()).norm() <= disc.radius_m) continue;
    drive.moving.push_back(
        {peer, distance_to_peers_m(robot_),
         standing ? std::numeric_limits<double>::infinity() : peer->rest_time()});
  }
  drive.duration_cost = DurationCost::total(options_.weight_duration);
  Effort effort;
  for (int attempt = 0; attempt < kAttempts && !should_stop(); ++attempt) {
    const auto found = optimizer_.optimize_drive(drive, obstacles, effort, should_stop);
    candidate.evaluations += found.evaluations;
    if (found.curve.pieces() == 0) return;
    candidate.terms = found.terms;
    prove(query, assemble(query, start_maneuver, found.curve), obstacles, candidate);
    if (candidate.motion.empty()) return;  // what the optimiser found is none
    const double slower = slow_down(candidate.violation);
    const bool from_rest = start_maneuver.state.col(1).isZero();
    const double most = attempt + 1 == kAttempts ? kSlowest : kRepairable;
    if (from_rest && slower > 1.0 && slower <= most) {
      prove(query, assemble(query, start_maneuver, found.curve.stretched(slower)), obstacles,
            candidate);
    }
    const double beside_s =
        candidate.motion.end_time() - candidate.motion.start_time() - found.curve.duration();
    candidate.terms.emplace_back("beside_drive", options_.weight_duration * beside_s);
    candidate.cost = found.cost + candidate.terms.back().second;
    if (!candidate.violation) return;
    effort = raised(effort, candidate.violation);
  }
}

PlanCandidate CandidatePlanner::plan(const PlanQuery& query, const CandidateSeed& seed,
                                     const PlanningScene& scene,
                                     const std::function<bool()>& should_stop) const {
  PlanCandidate candidate;
  candidate.signature = seed.signature;
  candidate.path = seed.start_maneuvers.front().path;
  for (const StartManeuver& start_maneuver : seed.start_maneuvers) {
    drive(query, start_maneuver, scene, should_stop, candidate);
    if (!candidate.motion.empty() && !candidate.violation) {
      candidate.reason = PlanReason::kSolved;
      return candidate;
    }
  }
  candidate.reason = should_stop() ? PlanReason::kBudgetExhausted : PlanReason::kNotCertified;
  return candidate;
}

}  // namespace mocha
