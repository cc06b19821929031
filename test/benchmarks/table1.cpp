// The paper's Table I: camouflage against waypoints, at 1, 5 and 8 m between knots, in the plane
// and in space; same evaluator, solver, start and stopping rule. Then weights that ask for speed.
// Prints JSON; the argument is the number of worlds of each kind.

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "benchmarks/table_plan.h"
#include "benchmarks/time_optimal.h"
#include "trajectory/arc_length.h"
#include "trajectory/extrema.h"

namespace mocha {
namespace {

constexpr double kSpacings_m[] = {1.0, 5.0, 8.0};

/// The smallest distance between the ball around the robot and an obstacle.
template <int D>
double clearance_m(const PiecewisePolynomial<D, 3>& curve, const ObstacleField<D>& field,
                   double radius_m) {
  constexpr double kStep_s = 1e-3;
  double least = std::numeric_limits<double>::infinity();
  for (double t = 0.0; t < curve.duration(); t += kStep_s) {
    least = std::min(least, field.sample(curve.position(t)).distance_m);
  }
  return least - radius_m;
}

class Rows {
 public:
  template <int D>
  void add(int world, double spacing_m, bool camouflage, const BenchmarkWorld<D>& where,
           const TableOptions& options) {
    const TablePlan<D> run = plan<D>(where, spacing_m, camouflage, options);
    const double length_m = arc_length(run.curve);
    const double total_s = run.curve.duration();
    const double kinematic_s =
        length_m / options.max_speed + options.max_speed / options.max_acceleration;
    const double own_s = time_optimal_s(run.curve, options.max_speed, options.max_acceleration);
    std::printf(
        "%s\n  {\"world\": %d, \"dim\": %d, \"method\": \"%s\", \"spacing_m\": %g, "
        "\"max_speed\": %g, \"max_acceleration\": %g, \"t_plan_s\": %.5g, \"evaluations\": %d, "
        "\"J\": %.7g, \"T_s\": %.5g, \"L_m\": %.5g, \"clearance_m\": %.4g, \"feasible\": %s, "
        "\"excess_speed\": %.4g, \"excess_acceleration\": %.4g, "
        "\"T_over_kinematic_limit\": %.5g, \"T_over_own_optimum\": %.5g}",
        first_ ? "" : ",", world, D, camouflage ? "camouflage" : "minco", spacing_m,
        options.max_speed, options.max_acceleration, run.t_plan_s, run.found.evaluations,
        run.found.cost, total_s, length_m, clearance_m<D>(run.curve, where.field, options.radius_m),
        run.feasible ? "true" : "false", max_speed(run.found.curve).value / options.max_speed - 1.0,
        max_acceleration(run.found.curve).value / options.max_acceleration - 1.0,
        total_s / kinematic_s, total_s / own_s);
    first_ = false;
  }

  template <int D>
  void add_table(int world, const BenchmarkWorld<D>& where) {
    for (const double spacing_m : kSpacings_m) {
      for (const bool camouflage : {false, true}) {
        add<D>(world, spacing_m, camouflage, where, TableOptions());
      }
    }
  }

 private:
  bool first_ = true;
};

/// Effort hardly counts: as fast as the limits allow.
TableOptions fast_options(double max_speed, double max_acceleration) {
  TableOptions options;
  options.w_e = 1e-3;
  options.max_speed = max_speed;
  options.max_acceleration = max_acceleration;
  return options;
}

void run(int worlds) {
  std::printf("{\"rows\": [");
  Rows table;
  for (int seed = 1; seed <= worlds; ++seed) table.add_table<2>(seed, circle_world(seed, {}));
  for (int seed = 1; seed <= worlds; ++seed) table.add_table<3>(seed, forest_world(seed, {}));
  std::printf("],\n\"fast\": [");
  Rows fast;
  for (int seed = 1; seed <= worlds; ++seed) {
    const BenchmarkWorld<2> world = circle_world(seed, {});
    fast.add<2>(seed, 5.0, true, world, fast_options(3.0, 2.0));
    fast.add<2>(seed, 5.0, true, world, fast_options(12.0, 5.0));
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { mocha::run(argc > 1 ? std::atoi(argv[1]) : 20); }
