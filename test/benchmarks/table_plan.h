#pragma once

#include <chrono>

#include "benchmarks/benchmark_problem.h"
#include "optimization/trajectory_optimizer.h"
#include "safety/curve_certificate.h"
#include "trajectory/time_scaling.h"

namespace mocha {

/// What planning for Table I gives.
template <int D>
struct TablePlan {
  OptimizedTrajectory<D, 3> found;
  double t_plan_s;
  PiecewisePolynomial<D, 3> curve;  ///< found, stretched to its limits
  bool feasible;
};

/// From the front-end path to a certified trajectory.
template <int D>
TablePlan<D> plan(const BenchmarkWorld<D>& world, double spacing_m, bool camouflage,
                  const TableOptions& options) {
  constexpr double kLongestStretch = 1.5;
  const OptimizerOptions stopping{20000, 1e-5, [] { return false; }};
  TablePlan<D> plan;
  const auto begin = std::chrono::steady_clock::now();
  const InitialKnots<D> knots = knots_on<D>(world.path, spacing_m, options);
  TrajectoryObjective<D, 3> objective(
      table_objective_options<D>(world, knots, camouflage, options));
  plan.found = optimize<D, 3>(objective, objective.initial(knots.durations_s), stopping);
  const auto stretch = smallest_stretch(
      plan.found.curve, {options.max_speed, options.max_acceleration, kLongestStretch});
  plan.curve = plan.found.curve.stretched(stretch.value_or(1.0));
  const CurveCertificate<D, 3> certificate(plan.curve);
  plan.feasible = !certificate.check_limits(options.max_speed, options.max_acceleration) &&
                  !certificate.check_clearance(options.radius_m, world.field, 0.0);
  plan.t_plan_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return plan;
}

}  // namespace mocha
