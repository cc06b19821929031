// The paper's Table I: camouflage against waypoints, at 1, 5 and 8 m between knots, in the plane and
// in space. Same evaluator, same solver, same stopping rule. Prints JSON.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "benchmarks/benchmark_problem.h"
#include "optimization/trajectory_optimizer.h"
#include "safety/curve_proof.h"
#include "trajectory/arc_length.h"
#include "trajectory/extrema.h"
#include "trajectory/time_scaling.h"

namespace mocha {
namespace {

constexpr double kSpacings_m[] = {1.0, 5.0, 8.0};
constexpr double kLongestStretch = 1.5;

OptimizerRules stopping_rules() {
  OptimizerRules rules;
  rules.max_evaluations = 20000;
  rules.relative_cost = 1e-5;
  rules.cost_window = 5;
  return rules;
}

template <int D>
struct Run {
  OptimizedTrajectory<D, 3> found;
  double t_plan_s;
  double speed_excess;         // relative, as optimised
  double acceleration_excess;  // likewise
  typename OptimizedTrajectory<D, 3>::Curve curve;  // scaled to its limits
  bool feasible;
};

/// From the front-end path to a certified trajectory.
template <int D>
Run<D> plan(const BenchmarkWorld<D>& world, double spacing_m, bool camouflage,
            const TableRules& rules) {
  Run<D> run;
  const auto begin = std::chrono::steady_clock::now();
  const InitialKnots<D> knots = knots_on<D>(world.path, spacing_m, rules);
  TrajectoryObjective<D, 3> objective(table_setup<D>(world, knots, camouflage, rules));
  run.found = optimize<D, 3>(objective, objective.initial(knots.durations_s), stopping_rules());
  const auto factor =
      stretch_to(run.found.curve, rules.max_speed, rules.max_acceleration, kLongestStretch);
  run.curve = run.found.curve.stretched(factor.value_or(1.0));
  run.feasible = factor && !check_clearance(run.curve, rules.clearance_m, world.field);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  run.t_plan_s = taken.count();
  run.speed_excess = max_speed(run.found.curve).value / rules.max_speed - 1.0;
  run.acceleration_excess = max_acceleration(run.found.curve).value / rules.max_acceleration - 1.0;
  return run;
}

template <int D>
double clearance_m(const PiecewisePolynomial<D, 3>& curve, const ObstacleField<D>& field) {
  constexpr double kStep_s = 1e-3;
  double least = std::numeric_limits<double>::infinity();
  for (double t = 0.0; t < curve.duration(); t += kStep_s) {
    least = std::min(least, field.sample(curve.position(t)).distance_m);
  }
  return least;
}

template <int D>
void print_rows(const BenchmarkWorld<D>& world, int seed, const TableRules& rules, bool& first) {
  for (const double spacing_m : kSpacings_m) {
    for (const bool camouflage : {false, true}) {
      const Run<D> run = plan<D>(world, spacing_m, camouflage, rules);
      const double length = arc_length(run.curve);
      const double limit_s =
          length / rules.max_speed + rules.max_speed / rules.max_acceleration;
      std::printf(
          "%s\n  {\"world\": %d, \"dim\": %d, \"method\": \"%s\", \"spacing_m\": %g, "
          "\"t_plan_s\": %.5g, \"evaluations\": %d, \"stop\": %d, \"J\": %.7g, \"T_s\": %.5g, "
          "\"L_m\": %.5g, \"clearance_m\": %.4g, \"feasible\": %s, \"excess_speed\": %.4g, "
          "\"excess_acceleration\": %.4g, \"T_over_kinematic_limit\": %.5g}",
          first ? "" : ",", seed, D, camouflage ? "camouflage" : "minco", spacing_m, run.t_plan_s,
          run.found.evaluations, static_cast<int>(run.found.stop), run.found.cost,
          run.curve.duration(), length, clearance_m<D>(run.curve, world.field),
          run.feasible ? "true" : "false", run.speed_excess, run.acceleration_excess,
          run.curve.duration() / limit_s);
      std::fflush(stdout);
      first = false;
    }
  }
}

void run(int worlds) {
  const TableRules rules;
  bool first = true;
  std::printf("{\"rows\": [");
  for (int seed = 1; seed <= worlds; ++seed) {
    print_rows<2>(circle_world(seed, {}), seed, rules, first);
  }
  for (int seed = 1; seed <= worlds; ++seed) {
    print_rows<3>(forest_world(seed, {}), seed, rules, first);
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { mocha::run(argc > 1 ? std::atoi(argv[1]) : 20); }
