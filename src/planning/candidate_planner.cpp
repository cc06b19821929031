#include "planning/candidate_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planning/escape_proof.h"
#include "planning/peer_discs.h"
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

CandidatePlanner::CandidatePlanner(const RobotModel& robot, const PlannerRules& rules)
    : robot_(robot),
      rules_(rules),
      margin_m_(MarginBudget::of(robot).static_margin_m()),
      optimizer_(robot, rules, margin_m_),
      front_end_(robot, rules, optimizer_.rest_acceleration()) {}

Violation CandidatePlanner::certify(const Motion& motion, const ObstacleField<2>& obstacles,
                                    double from_s) const {
  return check_clearance_or_leaving(motion, robot_.footprint, obstacles, margin_m_, from_s);
}

double CandidatePlanner::least_cost(const Approach& approach) const {
  double least_s = std::numeric_limits<double>::infinity();
  for (const Opening& opening : approach.openings) {
    const double speed = opening.state.col(1).norm();
    least_s = std::min(least_s, opening.duration_s + least_duration_s(approach.least_length_m,
                                                                      speed, robot_.limits));
  }
  return rules_.weight_duration * least_s;
}

Motion CandidatePlanner::assemble(const PlanQuery& query, const Opening& opening,
                                  PlanarPath curve) const {
  std::vector<Phase> phases = opening.phases;
  const DrivePhase drive{1, std::move(curve)};
  phases.emplace_back(drive);
  if (query.goal_yaw_rad) {
    const double end_s = drive.path.duration();
    const Pose end{drive.path.position(end_s), heading(drive, end_s)};
    const double change = wrap_angle(*query.goal_yaw_rad - end.yaw_rad);
    if (const auto turn = front_end_.openings().turn(end, change)) phases.emplace_back(*turn);
  }
  return Motion(query.start_time_s, std::move(phases));
}

void CandidatePlanner::prove(const PlanQuery& query, Motion motion,
                             const ObstacleField<2>& obstacles, PlanCandidate& candidate) const {
  candidate.motion = std::move(motion);
  candidate.violation = check_limits(candidate.motion, robot_.limits, query.start_time_s);
  if (!candidate.violation)
    candidate.violation = certify(candidate.motion, obstacles, query.start_time_s);
}

void CandidatePlanner::drive(const PlanQuery& query, const Opening& opening,
                             const PlanningScene& scene, const std::function<bool()>& should_stop,
                             PlanCandidate& candidate) const {
  const ObstacleField<2>& obstacles = scene.terrain->field();
  DriveQuery drive;
  drive.path = opening.path;
  drive.start = opening.state;
  drive.start_time_s = query.start_time_s + opening.duration_s;
  for (const auto& peer : scene.peers) {
    const bool standing = stands(*peer, query.start_time_s);
    const BlockedDisc disc = kept_from(*peer, query.start_time_s, robot_, 0.0);
    // A team-mate that stands on the goal will hardly stay: drive up, and let the promises keep
    // apart.
    if (standing && (disc.centre - opening.path.back()).norm() <= disc.radius_m) continue;
    drive.moving.push_back(
        {peer, distance_to_peers_m(robot_),
         standing ? std::numeric_limits<double>::infinity() : peer->rest_time()});
  }
  Effort effort;
  for (int attempt = 0; attempt < kAttempts && !should_stop(); ++attempt) {
    const auto found = optimizer_.optimize_drive(drive, obstacles, effort, should_stop);
    candidate.evaluations += found.evaluations;
    if (found.curve.pieces() == 0) return;
    candidate.terms = found.terms;
    prove(query, assemble(query, opening, found.curve), obstacles, candidate);
    const double slower = slow_down(candidate.violation);
    const bool from_rest = opening.state.col(1).isZero();
    const double most = attempt + 1 == kAttempts ? kSlowest : kRepairable;
    if (from_rest && slower > 1.0 && slower <= most) {
      prove(query, assemble(query, opening, found.curve.stretched(slower)), obstacles, candidate);
    }
    const double beside_s =
        candidate.motion.end_time() - candidate.motion.start_time() - found.curve.duration();
    candidate.terms.emplace_back("beside_drive", rules_.weight_duration * beside_s);
    candidate.cost = found.cost + candidate.terms.back().second;
    if (!candidate.violation) return;
    effort = raised(effort, candidate.violation);
  }
}

PlanCandidate CandidatePlanner::plan(const PlanQuery& query, const Approach& approach,
                                     const PlanningScene& scene,
                                     const std::function<bool()>& should_stop) const {
  PlanCandidate candidate;
  candidate.signature = approach.signature;
  candidate.way = approach.openings.front().path;
  for (const Opening& opening : approach.openings) {
    drive(query, opening, scene, should_stop, candidate);
    if (!candidate.motion.empty() && !candidate.violation) {
      candidate.reason = PlanReason::kSolved;
      return candidate;
    }
  }
  candidate.reason = should_stop() ? PlanReason::kBudgetExhausted : PlanReason::kNotCertified;
  return candidate;
}

}  // namespace mocha
