#include "planning/global_planner.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "planning/escape_proof.h"
#include "planning/retreat.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr int kAttempts = 8;               // of one optimisation, each with more effort
constexpr double kLookAhead_m = 0.3;       // of the path that gives its initial direction
constexpr double kRollingStart_rad = 1.2;  // between velocity and path; beyond, brake first
constexpr double kNoTurn_rad = 0.02;       // smaller changes of heading are left to the drive
constexpr double kStandsFor_s = 0.5;  // a team-mate that rests within this time counts as standing
constexpr double kFrontEndSlack_m = 0.01;  // over the proved margin, for the optimiser to work in
constexpr double kSlowest = 4.0;           // times as long as optimised: slower motions are none
constexpr double kRepairable = 1.03;       // not worth another optimisation
constexpr double kSlowDownSlack = 1.001;

Vector2 direction_ahead(const std::vector<Vector2>& path) {
  for (const Vector2& point : path) {
    if ((point - path.front()).norm() >= kLookAhead_m) return point - path.front();
  }
  return path.back() - path.front();
}

double yaw_of(const Vector2& direction) { return std::atan2(direction.y(), direction.x()); }
Vector2 unit(double yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }

PlanResult failure(PlanReason reason, const std::string& message) {
  PlanResult result;
  result.reason = reason;
  result.message = message;
  return result;
}

std::string place(const Vector2& p) {
  std::ostringstream text;
  text.precision(2);
  text << std::fixed << "(" << p.x() << ", " << p.y() << ")";
  return text.str();
}

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

double total_duration_s(const std::vector<Phase>& phases) {
  double total = 0.0;
  for (const Phase& phase : phases) total += duration_s(phase);
  return total;
}

}  // namespace

GlobalPlanner::GlobalPlanner(RobotModel robot, const PlannerRules& rules)
    : robot_(std::move(robot)),
      rules_(rules),
      margins_(MarginBudget::of(robot_)),
      optimizer_(robot_, rules_, margins_.static_margin_m()) {}

double GlobalPlanner::required_clearance_m() const {
  double radius = 0.0;
  for (const auto& disc : robot_.footprint.cover()) radius = std::max(radius, disc.radius_m);
  return radius + margins_.static_margin_m() + kFrontEndSlack_m;
}

Violation GlobalPlanner::certify(const Motion& motion, const DistanceField& obstacles,
                                 double from_s) const {
  return check_clearance_or_leaving(motion, robot_.footprint, obstacles, margins_.static_margin_m(),
                                    from_s);
}

BlockedDisc GlobalPlanner::kept_from(const MovingObstacle& peer, double t) const {
  const auto disc = peer.at(t);
  return {disc.centre, disc.radius_m + robot_.footprint.circumscribed_radius_m() +
                           robot_.peer_clearance_m + margins_.peer_margin_m() + kFrontEndSlack_m};
}

GridPath GlobalPlanner::find_path(const Vector2& start, const Vector2& goal, double start_time_s,
                                  const PlanningScene& scene) const {
  GridPathRules rules;
  rules.required_clearance_m = required_clearance_m();
  rules.preferred_clearance_m = required_clearance_m() + rules_.preferred_clearance_m;
  rules.clearance_weight = rules_.clearance_weight;
  std::vector<BlockedDisc> blocked;
  for (const auto& peer : scene.peers) {
    if (peer->rest_time() > start_time_s + kStandsFor_s) continue;  // moving: left to the optimiser
    const BlockedDisc disc = kept_from(*peer, start_time_s);
    if ((disc.centre - goal).norm() > disc.radius_m) blocked.push_back(disc);
  }
  return find_grid_path(*scene.obstacles, start, goal, blocked, rules);
}

std::optional<Vector2> GlobalPlanner::free_goal(const Vector2& goal,
                                                const DistanceField& obstacles) const {
  constexpr double kStep_m = 0.05;
  const double needed = required_clearance_m();
  for (double radius = 0.0; radius <= rules_.goal_search_radius_m; radius += kStep_m) {
    const int directions =
        radius == 0.0 ? 1 : std::max(8, static_cast<int>(2 * M_PI * radius / kStep_m));
    for (int i = 0; i < directions; ++i) {
      const Vector2 place = goal + radius * unit(2 * M_PI * i / directions);
      if (obstacles.distance_bound(place) >= needed) return place;
    }
  }
  return std::nullopt;
}

GlobalPlanner::Opening GlobalPlanner::from_rest(std::vector<Phase> phases, const Pose& pose,
                                                std::vector<Vector2> path, bool smooth) const {
  Opening opening;
  opening.phases = std::move(phases);
  const double path_yaw = yaw_of(direction_ahead(path));
  const double change = wrap_angle(path_yaw - pose.yaw_rad);
  double yaw = pose.yaw_rad;
  if (!smooth && std::abs(change) > kNoTurn_rad) {
    opening.phases.push_back(TurnPhase{
        pose, change,
        turn_duration_s(change, robot_.limits.max_yaw_rate, robot_.limits.max_yaw_acceleration)});
    yaw = path_yaw;
  }
  opening.duration_s = total_duration_s(opening.phases);
  opening.state << pose.position, Vector2::Zero(), optimizer_.rest_acceleration() * unit(yaw);
  opening.path = std::move(path);
  return opening;
}

std::vector<GlobalPlanner::Opening> GlobalPlanner::openings(const PlanQuery& query,
                                                            const PlanningScene& scene,
                                                            const Vector2& goal) const {
  std::vector<Opening> openings;
  const MotionState start = query.committed.at(query.start_time_s);
  const GridPath path = find_path(start.pose.position, goal, query.start_time_s, scene);
  if (path.outcome != GridPath::Outcome::kFound) return openings;
  const Vector2 ahead = direction_ahead(path.points);
  if (start.at_rest) {
    const double change = std::abs(wrap_angle(yaw_of(ahead) - start.pose.yaw_rad));
    if (change <= rules_.smooth_start_rad)
      openings.push_back(from_rest({}, start.pose, path.points, true));
    if (change > kNoTurn_rad) openings.push_back(from_rest({}, start.pose, path.points, false));
    return openings;
  }
  const double angle = std::abs(wrap_angle(yaw_of(ahead) - yaw_of(start.velocity)));
  if (angle <= kRollingStart_rad && start.speed > 0.0) {
    Opening rolling;
    rolling.state << start.pose.position, start.velocity, start.acceleration;
    rolling.path = path.points;
    openings.push_back(rolling);
  }
  std::vector<Phase> brake =
      brake_along(query.committed, query.start_time_s, optimizer_.rest_acceleration());
  const Motion stop(query.start_time_s, brake);
  const Pose rest = stop.end_pose();
  const GridPath onward = find_path(rest.position, goal, query.start_time_s, scene);
  if (onward.outcome == GridPath::Outcome::kFound) {
    openings.push_back(from_rest(std::move(brake), rest, onward.points, false));
  }
  return openings;
}

Motion GlobalPlanner::assemble(const PlanQuery& query, const Opening& opening,
                               PlanarPath curve) const {
  std::vector<Phase> phases = opening.phases;
  const DrivePhase drive{1, std::move(curve)};
  phases.push_back(drive);
  if (query.goal_yaw_rad) {
    const double yaw = heading(drive, drive.path.duration());
    const double change = wrap_angle(*query.goal_yaw_rad - yaw);
    if (std::abs(change) > kNoTurn_rad) {
      const Pose end{drive.path.position(drive.path.duration()), yaw};
      phases.push_back(TurnPhase{
          end, change,
          turn_duration_s(change, robot_.limits.max_yaw_rate, robot_.limits.max_yaw_acceleration)});
    }
  }
  return Motion(query.start_time_s, std::move(phases));
}

void GlobalPlanner::prove(const PlanQuery& query, Motion motion, const DistanceField& obstacles,
                          PlanCandidate& candidate) const {
  candidate.motion = std::move(motion);
  candidate.violation = check_limits(candidate.motion, robot_.limits, query.start_time_s);
  if (!candidate.violation)
    candidate.violation = certify(candidate.motion, obstacles, query.start_time_s);
}

PlanCandidate GlobalPlanner::drive_to(const PlanQuery& query, const Opening& opening,
                                      const PlanningScene& scene,
                                      const std::function<bool()>& should_stop) const {
  PlanCandidate candidate;
  DriveQuery drive{opening.path, opening.state, query.start_time_s + opening.duration_s, {}};
  for (const auto& peer : scene.peers) {
    const bool stands = peer->rest_time() <= query.start_time_s + kStandsFor_s;
    const BlockedDisc disc = kept_from(*peer, query.start_time_s);
    // A team-mate that stands on the goal will hardly stay: drive up, and let the promises keep
    // apart.
    if (stands && (disc.centre - opening.path.back()).norm() <= disc.radius_m) continue;
    drive.peers.push_back(
        {peer, stands ? std::numeric_limits<double>::infinity() : peer->rest_time()});
  }
  Effort effort;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto found = optimizer_.optimize_drive(drive, *scene.obstacles, effort, should_stop);
    candidate.evaluations += found.evaluations;
    if (found.curve.pieces() == 0) break;
    candidate.cost = found.cost;
    candidate.terms = found.terms;
    prove(query, assemble(query, opening, found.curve), *scene.obstacles, candidate);
    const double slower = slow_down(candidate.violation);
    const bool from_rest = opening.state.col(1).isZero();
    const double most = attempt + 1 == kAttempts ? kSlowest : kRepairable;
    if (from_rest && slower > 1.0 && slower <= most) {
      prove(query, assemble(query, opening, found.curve.stretched(slower)), *scene.obstacles,
            candidate);
    }
    if (!candidate.violation) {
      candidate.reason = PlanReason::kSolved;
      return candidate;
    }
    if (should_stop()) break;
    effort = raised(effort, candidate.violation);
  }
  candidate.reason = should_stop() ? PlanReason::kBudgetExhausted : PlanReason::kNotCertified;
  return candidate;
}

PlanResult GlobalPlanner::turn_only(const PlanQuery& query, const PlanningScene& scene) const {
  const Pose pose = query.committed.at(query.start_time_s).pose;
  const double change = query.goal_yaw_rad ? wrap_angle(*query.goal_yaw_rad - pose.yaw_rad) : 0.0;
  std::vector<Phase> phases;
  if (std::abs(change) > kNoTurn_rad) {
    phases.push_back(TurnPhase{
        pose, change,
        turn_duration_s(change, robot_.limits.max_yaw_rate, robot_.limits.max_yaw_acceleration)});
  } else {
    phases.push_back(StandPhase{pose, 0.1});
  }
  PlanResult result;
  result.motion = Motion(query.start_time_s, std::move(phases));
  result.goal = query.goal;
  result.violation = certify(result.motion, *scene.obstacles, query.start_time_s);
  result.reason = result.violation ? PlanReason::kNotCertified : PlanReason::kSolved;
  result.message = result.violation ? describe(result.violation) : "turns at the goal";
  return result;
}

std::optional<Motion> GlobalPlanner::back_out(const PlanQuery& query, const Vector2& goal,
                                              const PlanningScene& scene) const {
  const MotionState start = query.committed.at(query.start_time_s);
  if (!start.at_rest) return std::nullopt;
  const auto motion =
      retreat_along(query.trail, start.pose, query.start_time_s, rules_.back_out_m, robot_.limits);
  if (!motion || certify(*motion, *scene.obstacles, query.start_time_s)) return std::nullopt;
  // Worth while only if the goal can be reached from there, as far as the map says. Team-mates do
  // not count: they may go away.
  const PlanningScene without_peers{scene.obstacles, {}};
  const Vector2 end = motion->end_pose().position;
  const GridPath onward = find_path(end, goal, motion->end_time(), without_peers);
  return onward.outcome == GridPath::Outcome::kFound ? motion : std::nullopt;
}

PlanResult GlobalPlanner::plan(const PlanQuery& query, const PlanningScene& scene,
                               const std::function<bool()>& should_stop) const {
  if (!scene.obstacles) return failure(PlanReason::kNoMap, "there is no map yet");
  if (query.committed.empty())
    return failure(PlanReason::kNoPose, "the robot's state is not known yet");
  if (!query.goal.allFinite() || !std::isfinite(query.goal_yaw_rad.value_or(0.0))) {
    return failure(PlanReason::kInvalidInput, "the goal is not finite");
  }
  if (!std::isfinite(query.start_time_s)) {
    return failure(PlanReason::kInvalidInput, "the time to start at is not finite");
  }
  const MotionState start = query.committed.at(query.start_time_s);
  if (start.at_rest && (start.pose.position - query.goal).norm() < 0.03)
    return turn_only(query, scene);
  if (scene.obstacles->distance_bound(start.pose.position) <= 0.0) {
    return failure(PlanReason::kStartOccupied, "the robot at " + place(start.pose.position) +
                                                   " is inside an obstacle of the map");
  }
  const auto goal = free_goal(query.goal, *scene.obstacles);
  if (!goal) {
    return failure(PlanReason::kGoalOccupied, "the goal " + place(query.goal) +
                                                  " is occupied, and so is everything around it");
  }
  PlanResult result;
  result.reason = PlanReason::kNoPath;
  result.message =
      "no way from " + place(start.pose.position) + " to " + place(*goal) + " on the map";
  for (const Opening& opening : openings(query, scene, *goal)) {
    result.candidates.push_back(drive_to(query, opening, scene, should_stop));
    PlanCandidate& candidate = result.candidates.back();
    result.reason = candidate.reason;
    if (candidate.reason == PlanReason::kSolved) {
      candidate.selected = true;
      result.motion = candidate.motion;
      result.goal = *goal;
      result.violation = {};
      result.message = "solved";
      return result;
    }
    result.violation = candidate.violation;
    result.message = candidate.violation ? describe(candidate.violation)
                     : candidate.reason == PlanReason::kBudgetExhausted
                         ? "planning was stopped before a motion was found"
                         : "the optimisation found nothing finite";
  }
  if (const auto retreat = back_out(query, *goal, scene)) {
    result.reason = PlanReason::kBackingOut;
    result.message += "; backs out along the driven path";
    result.motion = *retreat;
  }
  return result;
}

}  // namespace mocha
