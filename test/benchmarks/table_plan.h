#pragma once

#include <chrono>

#include "benchmarks/benchmark_problem.h"
#include "optimization/adaptive_optimizer.h"
#include "optimization/pace.h"
#include "safety/curve_certificate.h"
#include "trajectory/time_scaling.h"

namespace mocha {

/// What planning for Table I gives.
template <int D>
struct TablePlan {
  OptimizedTrajectory<D, 3> found;
  long piece_evaluations;  ///< evaluations times pieces
  double t_plan_s;
  PiecewisePolynomial<D, 3> curve;  ///< found, stretched to its limits
  bool feasible;
};

/// One rule for all methods.
inline OptimizerOptions table_stopping() {
  return {20000, 1e-5, [] { return false; }};
}

/// From the front-end path to a certified trajectory; `search` fills in what was found and at what
/// effort.
template <int D, typename Search>
TablePlan<D> timed_plan(const BenchmarkWorld<D>& world, const TableOptions& options,
                        const Search& search) {
  constexpr double kLongestStretch = 1.5;
  TablePlan<D> plan;
  const auto begin = std::chrono::steady_clock::now();
  search(plan);
  const auto stretch = smallest_stretch(
      plan.found.curve, {options.max_speed, options.max_acceleration, kLongestStretch});
  plan.curve = plan.found.curve.stretched(stretch.value_or(1.0));
  const CurveCertificate<D, 3> certificate(plan.curve);
  plan.feasible = !certificate.check_limits(options.max_speed, options.max_acceleration) &&
                  !certificate.check_clearance(options.radius_m, *world.field, 0.0);
  plan.t_plan_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return plan;
}

/// Over knots `spacing_m` apart on average.
template <int D>
TablePlan<D> plan(const BenchmarkWorld<D>& world, double spacing_m, bool camouflage,
                  const TableOptions& options) {
  return timed_plan<D>(world, options, [&](TablePlan<D>& plan) {
    const InitialKnots<D> knots = knots_on<D>(world.path, spacing_m, options);
    TrajectoryObjective<D, 3> objective(
        table_objective_options<D>(world, knots, camouflage, options));
    plan.found = optimize<D, 3>(objective, objective.initial(paced(objective, knots.durations_s)),
                                table_stopping());
    plan.piece_evaluations = static_cast<long>(plan.found.evaluations) * objective.pieces();
  });
}

/// Over knots whose number and freedom are found as well.
template <int D>
TablePlan<D> plan_adaptively(const BenchmarkWorld<D>& world, const TableOptions& options) {
  constexpr double kSpacing_m = 3.0;  // of the knots to choose from
  constexpr int kCoarsest = 4;        // of these intervals to begin with
  constexpr double kTolerance_m = 1.0;
  return timed_plan<D>(world, options, [&](TablePlan<D>& plan) {
    const double coarsest_m = kCoarsest * kSpacing_m;
    const int pieces =
        kCoarsest * static_cast<int>(std::round(length_of<D>(world.path) / coarsest_m));
    const SpeedProfile<D> profile = table_profile<D>(world.path, kSpacing_m, options);
    const InitialKnots<D> knots = profile.knots(pieces);
    TrajectoryObjective<D, 3> objective(table_objective_options<D>(world, knots, false, options));
    const auto references = [&](const auto& path) {
      const auto chosen = choose_references<D>(path, *world.field, options.travel_m);
      return chosen ? std::optional(chosen.references) : std::nullopt;
    };
    const auto adaptive = optimize_adaptively<D>(
        objective, {knots.path, profile.duration_s(), kCoarsest, kTolerance_m, references},
        options.travel_m, table_stopping());
    plan.found = adaptive.found;
    plan.piece_evaluations = adaptive.piece_evaluations;
  });
}

/// J of a curve with samples 2 cm apart, the same measure for all methods: with few and long pieces
/// a curve may hop over a penalty between its samples.
template <int D>
double exact_cost(const BenchmarkWorld<D>& world, const PiecewisePolynomial<D, 3>& curve,
                  TableOptions options) {
  constexpr double kStep_m = 0.02;
  const int pieces = curve.pieces();
  InitialKnots<D> knots;
  knots.path.resize(D, pieces + 1);
  for (int i = 0; i < pieces; ++i) knots.path.col(i) = curve.derivative({i, 0.0}, 0);
  knots.path.col(pieces) = curve.position(curve.duration());
  knots.durations_s =
      Eigen::Map<const Eigen::VectorXd>(curve.durations().data(), curve.durations().size());
  options.kappa =
      static_cast<int>(std::ceil(knots.durations_s.maxCoeff() * options.max_speed / kStep_m));
  TrajectoryObjective<D, 3> objective(table_objective_options<D>(world, knots, false, options));
  Eigen::VectorXd gradient(objective.variables());
  return objective.evaluate(objective.initial(knots.durations_s), gradient);
}

}  // namespace mocha
