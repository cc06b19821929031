#include "planning/space/space_optimizer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "optimization/dynamics_penalty.h"
#include "optimization/obstacle_penalty.h"
#include "optimization/trajectory_optimizer.h"
#include "planning/candidates/knot_map_choice.h"
#include "planning/candidates/knot_spacing.h"
#include "planning/candidates/speed_profile.h"
#include "safety/curve_certificate.h"
#include "trajectory/time_scaling.h"

namespace mocha {
namespace {

constexpr int kAttempts = 4;
constexpr double kMoreWeight = 10.0;
constexpr double kFiner = 0.7;
// Penalties let limits be exceeded a little; optimising for slightly less keeps the result inside.
constexpr double kShareOfLimits = 0.97;
constexpr double kConvergedCost = 1e-4;
constexpr double kLongestStretch = 1.5;
constexpr int kChordsOfPiece = 32;

/// The class of a curve, by chords that are short beside what it keeps from obstacles.
Signature signature_along(const PiecewisePolynomial<3, 3>& curve, const Cuts<3>& cuts) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < curve.pieces(); ++i) {
    for (int k = 0; k < kChordsOfPiece; ++k)
      points.push_back(
          curve.position(curve.piece_start(i) + curve.piece_duration(i) * k / kChordsOfPiece));
  }
  points.push_back(curve.position(curve.duration()));
  return signature_of<3>(cuts, points);
}

}  // namespace

OptimizedTrajectory<3, 3> SpaceOptimizer::optimized(
    const std::vector<Eigen::Vector3d>& path, const ObstacleField<3>& field, Push& push,
    const std::function<bool()>& should_stop) const {
  MotionLimits limits;
  limits.max_speed = options_.max_speed;
  limits.max_acceleration = options_.max_acceleration;
  limits.max_yaw_rate = std::numeric_limits<double>::infinity();
  const double spacing_m = knot_spacing_for_room<3>(
      path, field, {options_.knot_spacing_m, options_.open_knot_spacing_m});
  const InitialKnots<3> knots = spread_knots<3>(path, 0.0, limits, push.spacing * spacing_m);
  TrajectoryObjective<3, 3>::Options options;
  options.start.setZero();
  options.end.setZero();
  options.start.col(0) = path.front();
  options.end.col(0) = path.back();
  options.knot_map = choose_knot_map<3>(knots.path, field, options_.knot_travel_m, push.fallback);
  options.effort_weight =
      options_.weight_effort / (options_.max_acceleration * options_.max_acceleration);
  options.duration_cost = DurationCost::total(options_.weight_duration);
  options.kappa = options_.samples_per_piece;
  options.metres_per_eta = knots.metres_per_eta();
  const double safety_m = options_.required_clearance_m() + options_.soft_margin_m;
  options.penalties.push_back(
      std::make_unique<ObstaclePenalty<3>>(options_.weight_obstacle * push.obstacle_weight, field,
                                           std::vector<ObstacleCover>{{0.0, safety_m}}, 1.0));
  options.penalties.push_back(std::make_unique<DynamicsPenalty<3>>(
      options_.weight_dynamics, kShareOfLimits * options_.max_speed,
      kShareOfLimits * options_.max_acceleration));
  TrajectoryObjective<3, 3> objective(std::move(options));
  auto found = optimize<3, 3>(objective, objective.initial(knots.durations_s),
                              {options_.max_evaluations, kConvergedCost, should_stop});
  found.cost = 0.0;  // at the weights of the options, so that candidates compare
  for (auto& [name, value] : found.terms) {
    if (name == "obstacle") value /= push.obstacle_weight;
    found.cost += value;
  }
  return found;
}

BasicViolation<3> SpaceOptimizer::first_violation(const PiecewisePolynomial<3, 3>& curve,
                                                  const ObstacleField<3>& field) const {
  const CurveCertificate<3, 3> certificate(curve);
  const auto limits = certificate.check_limits(options_.max_speed, options_.max_acceleration);
  return limits ? limits : certificate.check_clearance(options_.radius_m, field, options_.margin_m);
}

SpaceCandidate SpaceOptimizer::optimize_path(const std::vector<Eigen::Vector3d>& path,
                                             const ObstacleField<3>& field, const Cuts<3>& cuts,
                                             const std::function<bool()>& should_stop) const {
  SpaceCandidate candidate;
  candidate.path = path;
  Push push;
  for (int attempt = 0; attempt < kAttempts && !should_stop(); ++attempt) {
    auto found = optimized(path, field, push, should_stop);
    candidate.evaluations += found.evaluations;
    if (found.curve.pieces() == 0) return candidate;
    const auto stretch = smallest_stretch(
        found.curve, {options_.max_speed, options_.max_acceleration, kLongestStretch});
    candidate.curve = found.curve.stretched(stretch.value_or(1.0));
    candidate.cost = found.cost;
    candidate.terms = std::move(found.terms);
    candidate.parameterisation = found.parameterisation;
    candidate.fallback = push.fallback;
    candidate.violation = first_violation(candidate.curve, field);
    if (!candidate.violation) {
      candidate.reason = PlanReason::kSolved;
      break;
    }
    push.obstacle_weight *= kMoreWeight;
    push.spacing *= kFiner;
    if (attempt + 2 == kAttempts && !push.fallback)
      push.fallback = {FallbackKind::kCamouflageGivenUp, candidate.violation.place};
  }
  if (candidate.curve.pieces() > 0) candidate.signature = signature_along(candidate.curve, cuts);
  return candidate;
}

}  // namespace mocha
