#include "planning/candidates/drive_optimizer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "camouflage/camouflage_map.h"
#include "camouflage/reference_point.h"
#include "optimization/clearance_penalty.h"
#include "optimization/dynamics_penalty.h"
#include "optimization/obstacle_penalty.h"
#include "optimization/turning_penalty.h"
#include "optimization/wheel_penalty.h"
#include "optimization/zone_speed_penalty.h"
#include "planning/candidates/knot_spacing.h"
#include "planning/candidates/path_clearance.h"
#include "planning/candidates/start_maneuver.h"
#include "planning/candidates/timed_guide.h"

namespace mocha {
namespace {

// Penalties let limits be exceeded a little; optimising for slightly less keeps the result inside
// the true ones.
constexpr double kShareOfSpeed = 0.97;
constexpr double kShareOfAcceleration = 0.95;
constexpr double kShareOfYawRate = 0.92;
constexpr double kShareOfWheelSpeed = 0.97;
constexpr double kShareOfRoom_m = 0.005;
// A search has converged where the cost falls by less. With a model of the curvature, each step
// goes farther: measured on maps of 100 m and of lidar logs, drives of many pieces come out no
// worse than without it, in half to seven tenths of the time; those of few pieces gain nothing.
constexpr double kRelativeCost = 1e-4;
constexpr double kRelativeModelledCost = 1e-3;
constexpr int kManyPieces = 50;
constexpr double kNarrowStep_m = 0.05;  // between the places where a path may be narrow, at least
constexpr double kLeastTimedPieces = 3.0;
constexpr double kMostTimedPieces = 60.0;
constexpr double kSoftSpeed =
    0.05;  // [m/s] below which heading and turning fade out of the penalties

/// Direction of the last stretch of about `length_m` of a path.
Vector2 final_direction(const std::vector<Vector2>& path, double length_m) {
  const Vector2 end = path.back();
  for (auto point = path.rbegin() + 1; point != path.rend(); ++point) {
    if ((end - *point).norm() >= length_m) return (end - *point).normalized();
  }
  return (end - path.front()).normalized();
}

/// Whether there is a problem to solve at all. What is merely hopeless, such as a start faster than
/// the robot, is for the certificate to say.
bool is_sound(const DriveQuery& query) {
  constexpr double kFarthest = 1e6;  // [m], [m/s], [m/s^2]; beyond, nothing can be computed
  if (query.path.size() < 2 || !std::isfinite(query.start_time_s)) return false;
  if (!query.times_s.empty() && query.times_s.size() != query.path.size()) return false;
  for (const Vector2& point : query.path) {
    if (!(point.cwiseAbs().maxCoeff() < kFarthest)) return false;
  }
  return query.start.cwiseAbs().maxCoeff() < kFarthest &&
         (query.path.back() - query.path.front()).norm() + (query.path[1] - query.path[0]).norm() >
             0.0;
}

/// The cost at the weights of the options, so that drives found with different effort compare.
void undo(const Effort& effort, OptimizedTrajectory<2, 3>& found) {
  found.cost = 0.0;
  for (auto& [name, value] : found.terms) {
    if (name == "obstacle" || name == "clearance") value /= effort.obstacle_weight;
    if (name == "moving") value /= effort.moving_weight;
    if (name == "dynamics" || name == "turning" || name == "wheels" || name == "zones")
      value /= effort.limit_weight;
    found.cost += value;
  }
}

}  // namespace

DriveOptimizer::DriveOptimizer(const RobotModel& robot, const DriveOptions& options,
                               const SpeedMargin& static_margin)
    : robot_(robot), options_(options), static_margin_(static_margin) {}

Effort raised(const Effort& effort, const Violation& violation, double factor) {
  Effort more = effort;
  more.from_found = false;
  switch (violation.term) {
    case ViolatedTerm::kClearance:
      more.obstacle_weight *= factor;
      break;
    case ViolatedTerm::kSeparation:
      more.moving_weight *= factor;
      break;
    default:
      more.limit_weight *= factor;
  }
  if (!more.fallback && effort.spacing != 1.0)
    more.fallback = Fallback{FallbackKind::kCamouflageGivenUp, violation.place};
  more.spacing = std::max(0.4, 0.7 * effort.spacing);
  if (more.fallback) more.speed *= 0.8;
  return more;
}

const MotionLimits& DriveOptimizer::limits_of(const DriveQuery& query) const {
  return query.limits ? *query.limits : robot_.limits;
}

std::shared_ptr<const KnotMap<2>> DriveOptimizer::knot_map(
    const Eigen::Matrix2Xd& path, const ObstacleField<2>& field,
    std::optional<Fallback>& fallback) const {
  const Eigen::Matrix2Xd prey = path.middleCols(1, path.cols() - 2);
  if (!fallback) {
    const auto chosen = choose_references(path, field, options_.knot_travel_m);
    if (chosen)
      return std::make_shared<CamouflageMap<2>>(prey, chosen.references, options_.knot_travel_m);
    fallback = fallback_of(chosen);
  }
  return std::make_shared<WaypointMap<2>>(prey);
}

std::vector<std::unique_ptr<Penalty<2>>> DriveOptimizer::penalties(const DriveQuery& query,
                                                                   const ObstacleField<2>& field,
                                                                   const Effort& effort) const {
  const MotionLimits& limits = limits_of(query);
  const double max_speed = robot_.limits.max_speed;
  const double wished_m = static_margin_.at(max_speed) + options_.soft_margin_m;
  std::vector<ObstacleCover> wished;
  std::vector<ClearanceCover> required;
  for (const CoverDisc& disc : robot_.footprint.soft_cover()) {
    const double inside_m = std::min(disc.radius_m, robot_.footprint.depth_m(disc.offset_m));
    const SpeedMargin least(inside_m + static_margin_.still_m + kShareOfRoom_m,
                            static_margin_.per_speed2);
    const Vector2 offset_m = query.direction * disc.offset_m;  // in the direction of travel
    wished.push_back({offset_m.x(), disc.radius_m + wished_m, offset_m.y()});
    required.push_back({offset_m.x(), least, max_speed, offset_m.y()});
  }
  std::vector<std::unique_ptr<Penalty<2>>> penalties;
  const double weight = options_.weight_obstacle * effort.obstacle_weight;
  penalties.push_back(
      std::make_unique<ObstaclePenalty<2>>(weight, field, std::move(wished), kSoftSpeed));
  // Steep, so it takes evaluations: only where the speed is to follow the room.
  if (effort.obstacle_weight > 1.0 || is_narrow(query.path, field))
    penalties.push_back(
        std::make_unique<ClearancePenalty<2>>(weight, field, std::move(required), kSoftSpeed));
  penalties.push_back(
      std::make_unique<DynamicsPenalty<2>>(options_.weight_dynamics * effort.limit_weight,
                                           kShareOfSpeed * effort.speed * limits.max_speed,
                                           kShareOfAcceleration * limits.max_acceleration));
  penalties.push_back(
      std::make_unique<TurningPenalty>(options_.weight_turning * effort.limit_weight,
                                       kShareOfYawRate * limits.max_yaw_rate, kSoftSpeed));
  if (query.speed_zones) {
    penalties.push_back(std::make_unique<ZoneSpeedPenalty>(
        options_.weight_dynamics * effort.limit_weight, query.speed_zones, query.start_time_s,
        kShareOfSpeed * effort.speed, limits.max_acceleration));
  }
  if (!limits.wheels_are_ample()) {
    MotionLimits wheels = limits;
    wheels.max_wheel_speed *= kShareOfWheelSpeed;
    penalties.push_back(std::make_unique<WheelPenalty>(
        options_.weight_dynamics * effort.limit_weight, wheels, kSoftSpeed));
  }
  if (!query.moving.empty()) {
    std::vector<MovingThing> others = query.moving;
    for (MovingThing& other : others) other.keep_m += options_.moving_soft_margin_m;
    penalties.push_back(std::make_unique<MovingPenalty>(
        options_.weight_moving * effort.moving_weight, query.start_time_s, std::move(others)));
  }
  return penalties;
}

double DriveOptimizer::fastest_at(const Vector2& place, const ObstacleField<2>& field) const {
  const double max_speed = robot_.limits.max_speed;
  const double body_m = robot_.footprint.inscribed_radius_m() + kShareOfRoom_m;
  const double lacking_m = body_m + static_margin_.at(max_speed) - field.distance_bound(place);
  if (lacking_m <= 0.0) return max_speed;
  const Vector2 off = lacking_m * field.sample(place).gradient;
  double distance_m = 0.0;
  for (const double share : {0.0, 0.6, 1.2})
    distance_m = std::max(distance_m, field.distance_bound(place + share * off));
  const double room_m = distance_m - body_m;
  if (room_m < static_margin_.still_m) return max_speed;
  return std::min(max_speed, std::max(kCreep_mps, static_margin_.fastest(room_m)));
}

bool DriveOptimizer::is_narrow(const std::vector<Vector2>& path,
                               const ObstacleField<2>& field) const {
  const double max_speed = robot_.limits.max_speed;
  const double roomy_m = robot_.footprint.inscribed_radius_m() + static_margin_.at(max_speed);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 way = path[i] - path[i - 1];
    const double length_m = way.norm();
    for (double along_m = 0.0; along_m < length_m;) {
      const Vector2 place = path[i - 1] + (along_m / length_m) * way;
      if (fastest_at(place, field) < max_speed) return true;
      along_m += std::max(kNarrowStep_m, field.distance_bound(place) - roomy_m);
    }
  }
  return false;
}

InitialKnots<2> DriveOptimizer::initial_knots(const DriveQuery& query,
                                              const ObstacleField<2>& field,
                                              const Effort& effort) const {
  if (query.found_before && effort.from_found) return *query.found_before;
  MotionLimits limits = limits_of(query);
  limits.max_speed *= effort.speed;
  if (query.times_s.empty()) {
    const double spacing_m = knot_spacing_for_room<2>(
        query.path, field, {options_.knot_spacing_m, options_.open_knot_spacing_m});
    return spread_knots<2>(query.path, query.start.col(1).norm(), limits,
                           effort.spacing * spacing_m, [&](const Vector2& place) {
                             const double fastest = fastest_at(place, field);
                             return query.speed_zones
                                        ? std::min(fastest, query.speed_zones->fastest_at(place))
                                        : fastest;
                           });
  }
  const double piece_s = effort.spacing * options_.knot_spacing_m / limits.max_speed;
  const double pieces = std::ceil(query.times_s.back() / piece_s);
  const double window_s =
      std::min(limits.max_speed / limits.max_acceleration, 0.5 * query.times_s.back());
  TimedGuide<2> guide{query.path, query.times_s};
  guide.start_velocity = query.start.col(1);
  if (query.rejoin) guide.end_velocity = query.rejoin->col(1);
  return even_knots(
      guide, static_cast<int>(std::clamp(pieces, kLeastTimedPieces, kMostTimedPieces)), window_s);
}

PlanarMinco::State DriveOptimizer::end_state(const DriveQuery& query) const {
  if (query.rejoin) return *query.rejoin;
  PlanarMinco::State end;
  end.col(0) = query.path.back();
  end.col(1).setZero();
  end.col(2) = -rest_acceleration(limits_of(query)) * final_direction(query.path, 0.3);
  return end;
}

OptimizedDrive DriveOptimizer::optimize_drive(const DriveQuery& query,
                                              const ObstacleField<2>& field, const Effort& effort,
                                              const std::function<bool()>& should_stop,
                                              double most_work) const {
  if (!is_sound(query)) return {};
  const InitialKnots<2> knots = initial_knots(query, field, effort);
  const double a_max = limits_of(query).max_acceleration;
  TrajectoryObjective<2, 3>::Options options;
  options.start = query.start;
  options.end = end_state(query);
  std::optional<Fallback> fallback = effort.fallback;
  options.knot_map = knot_map(knots.path, field, fallback);
  options.effort_weight = options_.weight_effort / (a_max * a_max);
  options.duration_cost = query.duration_cost;
  options.penalties = penalties(query, field, effort);
  options.kappa = options_.samples_per_piece;
  options.metres_per_eta = knots.metres_per_eta();
  TrajectoryObjective<2, 3> objective(std::move(options));
  const bool many = objective.pieces() >= kManyPieces;
  const double affordable = std::max(1.0, most_work / objective.pieces());
  const int evaluations = static_cast<int>(std::min<double>(options_.max_evaluations, affordable));
  OptimizedDrive found{optimize<2, 3>(objective, objective.initial(knots.durations_s),
                                      {evaluations, many ? kRelativeModelledCost : kRelativeCost,
                                       should_stop, many}),
                       {}};
  if (fallback) found.fallbacks.push_back(*fallback);
  undo(effort, found);
  return found;
}

}  // namespace mocha
