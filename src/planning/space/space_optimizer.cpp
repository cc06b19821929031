#include "planning/space/space_optimizer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "camouflage/reference_point.h"
#include "optimization/dynamics_penalty.h"
#include "optimization/obstacle_penalty.h"
#include "optimization/trajectory_optimizer.h"
#include "optimization/tube_penalty.h"
#include "planning/candidates/knot_spacing.h"
#include "planning/candidates/timed_guide.h"
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
constexpr int kCoarsestPieces = 4;        // knots to choose from, in the longest pieces
constexpr double kToleranceOfRoom = 0.5;  // of the soft margin, by which curves may leave the path
/// The class of a curve, by chords of about `step_s`.
Signature signature_along(const PiecewisePolynomial<3, 3>& curve, const Cuts<3>& cuts,
                          double step_s) {
  const int steps = static_cast<int>(std::ceil(curve.duration() / step_s));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= steps; ++i) points.push_back(curve.position(curve.duration() * i / steps));
  return signature_of<3>(cuts, points);
}

}  // namespace

KnotCandidates<3> SpaceOptimizer::candidates_on(const TimedSpacePath& path, const SpaceScene& scene,
                                                double spacing) const {
  MotionLimits limits;
  limits.max_speed = options_.max_speed;
  limits.max_acceleration = options_.max_acceleration;
  limits.max_yaw_rate = std::numeric_limits<double>::infinity();
  const double spacing_m =
      spacing * knot_spacing_for_room<3>(path.points, scene.field,
                                         {options_.knot_spacing_m, options_.open_knot_spacing_m});
  const auto pieces_of = [&](double count) {
    return kCoarsestPieces * std::max(1, static_cast<int>(std::round(count / kCoarsestPieces)));
  };
  KnotCandidates<3> candidates;
  candidates.coarsest = kCoarsestPieces;
  candidates.tolerance_m = kToleranceOfRoom * options_.soft_margin_m + 1e-3;
  if (path.times_s.empty()) {
    const SpeedProfile<3> profile(path.points, 0.0, limits, spacing_m, {});
    candidates.duration_s = profile.duration_s();
    candidates.path =
        profile.knots(pieces_of(options_.max_speed * candidates.duration_s / spacing_m)).path;
  } else {
    candidates.duration_s = path.times_s.back();
    const double window_s =
        std::min(options_.max_speed / options_.max_acceleration, 0.5 * candidates.duration_s);
    candidates.path =
        even_knots<3>({path.points, path.times_s},
                      pieces_of(options_.max_speed * candidates.duration_s / spacing_m), window_s)
            .path;
  }
  return candidates;
}

TrajectoryObjective<3, 3>::Options SpaceOptimizer::objective_options(
    const KnotCandidates<3>& candidates, const SpaceScene& scene, double weight) const {
  TrajectoryObjective<3, 3>::Options options;
  options.start.setZero();
  options.end.setZero();
  options.start.col(0) = candidates.path.leftCols(1);
  options.end.col(0) = candidates.path.rightCols(1);
  options.knot_map =
      std::make_shared<WaypointMap<3>>(candidates.path.middleCols(1, candidates.path.cols() - 2));
  options.effort_weight =
      options_.weight_effort / (options_.max_acceleration * options_.max_acceleration);
  options.duration_cost = DurationCost::total(options_.weight_duration);
  options.kappa = options_.samples_per_piece;
  const auto intervals = candidates.path.cols() - 1;
  options.metres_per_eta =
      InitialKnots<3>{candidates.path,
                      Eigen::VectorXd::Constant(intervals, candidates.duration_s / intervals)}
          .metres_per_eta();
  const double required_m = options_.required_clearance_m();
  options.penalties.push_back(std::make_unique<ObstaclePenalty<3>>(
      weight * options_.weight_obstacle, scene.field,
      std::vector<ObstacleCover>{{0.0, required_m + options_.soft_margin_m}}, 1.0));
  options.penalties.push_back(std::make_unique<DynamicsPenalty<3>>(
      options_.weight_dynamics, kShareOfLimits * options_.max_speed,
      kShareOfLimits * options_.max_acceleration));
  if (scene.moving.empty()) return options;
  std::vector<Tube<3>> wished;
  for (const Tube<3>& tube : scene.moving)
    wished.push_back(enlarged<3>(tube, required_m + options_.soft_margin_m));
  options.penalties.push_back(
      std::make_unique<TubePenalty<3>>(weight * options_.weight_moving, wished));
  return options;
}

void SpaceOptimizer::optimize_once(const TimedSpacePath& path, const SpaceScene& scene,
                                   const Push& push, const std::function<bool()>& should_stop,
                                   SpaceCandidate& candidate) const {
  KnotCandidates<3> candidates = candidates_on(path, scene, push.spacing);
  std::optional<BasicFallback<3>> fallback;
  candidates.references = [&](const Eigen::Matrix3Xd& knots) -> std::optional<Eigen::Matrix3Xd> {
    const auto chosen = choose_references<3>(knots, scene.field, options_.knot_travel_m);
    if (chosen) return chosen.references;
    fallback = fallback_of(chosen);
    return std::nullopt;
  };
  TrajectoryObjective<3, 3> objective(objective_options(candidates, scene, push.weight));
  auto [found, chain, work] =
      optimize_adaptively<3>(objective, candidates, options_.knot_travel_m,
                             {options_.max_evaluations, kConvergedCost, should_stop});
  candidate.evaluations += found.evaluations;
  if (found.curve.pieces() == 0) return;
  const auto stretch = smallest_stretch(
      found.curve, {options_.max_speed, options_.max_acceleration, kLongestStretch});
  candidate.curve = found.curve.stretched(stretch.value_or(1.0));
  candidate.parameterisation = found.parameterisation;
  candidate.fallback = fallback;
  const double factor = stretch.value_or(1.0);
  candidate.cost = 0.0;  // of the stretched curve, at the weights of the options
  for (auto& [name, value] : found.terms) {
    value *= name == "control_effort" ? std::pow(factor, -5) : factor;
    if (name == "obstacle" || name == "moving") value /= push.weight;
    candidate.cost += value;
  }
  candidate.terms = std::move(found.terms);
  candidate.violation = first_violation(candidate.curve, scene);
  if (!candidate.violation) candidate.reason = PlanReason::kSolved;
}

BasicViolation<3> SpaceOptimizer::first_violation(const PiecewisePolynomial<3, 3>& curve,
                                                  const SpaceScene& scene) const {
  const CurveCertificate<3, 3> certificate(curve);
  // Limits come last: where there is no room, the optimiser exceeds them as well.
  auto violation = certificate.check_clearance(options_.radius_m, scene.field, options_.margin_m);
  for (std::size_t i = 0; !violation && i < scene.moving.size(); ++i)
    violation = certificate.check_separation(options_.radius_m, scene.moving[i], options_.margin_m);
  if (violation) return violation;
  return certificate.check_limits(options_.max_speed, options_.max_acceleration);
}

SpaceCandidate SpaceOptimizer::optimize_path(const TimedSpacePath& path, const SpaceScene& scene,
                                             const std::function<bool()>& should_stop) const {
  SpaceCandidate candidate;
  candidate.path = path.points;
  Push push;
  for (int attempt = 0; attempt < kAttempts && !should_stop(); ++attempt) {
    optimize_once(path, scene, push, should_stop, candidate);
    if (candidate.reason == PlanReason::kSolved || candidate.curve.pieces() == 0) break;
    push.weight *= kMoreWeight;
    push.spacing *= kFiner;
  }
  if (candidate.curve.pieces() > 0)
    candidate.signature = signature_along(
        candidate.curve, scene.cuts, 0.5 * options_.required_clearance_m() / options_.max_speed);
  return candidate;
}

}  // namespace mocha
