// The paper's Table I: camouflage against waypoints, at 1 to 8 m between knots, and against knots
// whose number and freedom are found as well; in the plane and in space, open, dense and built;
// same evaluator, solver, start and stopping rule. Then weights that ask for speed. Prints JSON;
// the arguments are the number of worlds of each kind and the first seed.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "benchmarks/built_worlds.h"
#include "benchmarks/table_plan.h"
#include "benchmarks/time_optimal.h"
#include "trajectory/arc_length.h"
#include "trajectory/extrema.h"

namespace mocha {
namespace {

constexpr double kSpacings_m[] = {1.0, 3.0, 5.0, 8.0};

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

/// One way to plan; adaptive without a spacing.
struct Method {
  const char* name;
  double spacing_m;
};
constexpr Method kAdaptive{"adaptive", 0.0};

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const double spacing_m : kSpacings_m) {
    for (const char* name : {"minco", "camouflage"}) methods.push_back({name, spacing_m});
  }
  methods.push_back(kAdaptive);
  return methods;
}

template <int D>
TablePlan<D> plan_by(const Method& method, const BenchmarkWorld<D>& where,
                     const TableOptions& options) {
  if (method.spacing_m == 0.0) return plan_adaptively<D>(where, options);
  const bool camouflage = std::string(method.name) == "camouflage";
  return plan<D>(where, method.spacing_m, camouflage, options);
}

/// Plans by each method in turn, again and again, so that all meet the same load of the machine;
/// the times are the least of each. Slow ones are planned once.
template <int D>
std::vector<TablePlan<D>> plan_in_turns(const std::vector<Method>& methods,
                                        const BenchmarkWorld<D>& where,
                                        const TableOptions& options) {
  constexpr int kTurns = 7;
  constexpr double kSlow_s = 0.2;
  std::vector<TablePlan<D>> plans;
  for (const Method& method : methods) plans.push_back(plan_by<D>(method, where, options));
  for (int turn = 1; turn < kTurns; ++turn) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      if (plans[i].t_plan_s > kSlow_s) continue;
      const double again_s = plan_by<D>(methods[i], where, options).t_plan_s;
      plans[i].t_plan_s = std::min(plans[i].t_plan_s, again_s);
    }
  }
  return plans;
}

class Rows {
 public:
  template <int D>
  void add(const char* kind, int world, const std::vector<Method>& methods,
           const BenchmarkWorld<D>& where, const TableOptions& options) {
    const std::vector<TablePlan<D>> plans = plan_in_turns<D>(methods, where, options);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      std::printf(
          "%s\n  {\"kind\": \"%s\", \"world\": %d, \"dim\": %d, \"method\": \"%s\", "
          "\"spacing_m\": %g, ",
          first_ ? "" : ",", kind, world, D, methods[i].name, methods[i].spacing_m);
      print<D>(plans[i], where, options);
      first_ = false;
    }
  }

 private:
  template <int D>
  static void print(const TablePlan<D>& run, const BenchmarkWorld<D>& where,
                    const TableOptions& options) {
    const double length_m = arc_length(run.curve);
    const double total_s = run.curve.duration();
    const double kinematic_s =
        length_m / options.max_speed + options.max_speed / options.max_acceleration;
    const double own_s = time_optimal_s(run.curve, options.max_speed, options.max_acceleration);
    std::printf(
        "\"max_speed\": %g, \"max_acceleration\": %g, \"t_plan_s\": %.5g, \"evaluations\": %d, "
        "\"piece_evaluations\": %ld, \"pieces\": %d, \"variables\": %d, \"J\": %.7g, "
        "\"J_sampled\": %.7g, \"T_s\": %.5g, \"L_m\": %.5g, \"clearance_m\": %.4g, "
        "\"feasible\": %s, \"excess_speed\": %.4g, \"excess_acceleration\": %.4g, "
        "\"T_over_kinematic_limit\": %.5g, \"T_over_own_optimum\": %.5g}",
        options.max_speed, options.max_acceleration, run.t_plan_s, run.found.evaluations,
        run.piece_evaluations, run.found.curve.pieces(),
        static_cast<int>(run.found.variables.size()),
        exact_cost<D>(where, run.found.curve, options), run.found.cost, total_s, length_m,
        clearance_m<D>(run.curve, *where.field, options.radius_m), run.feasible ? "true" : "false",
        max_speed(run.found.curve).value / options.max_speed - 1.0,
        max_acceleration(run.found.curve).value / options.max_acceleration - 1.0,
        total_s / kinematic_s, total_s / own_s);
  }

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

void run(int first, int last) {
  const std::vector<Method> methods = all_methods();
  std::printf("{\"rows\": [");
  Rows table;
  for (int seed = first; seed <= last; ++seed) {
    table.add<2>("open", seed, methods, circle_world(seed, kCircles), TableOptions());
    table.add<3>("open", seed, methods, forest_world(seed, kForest), TableOptions());
    table.add<2>("dense", seed, methods, circle_world(seed, kDenseCircles), TableOptions());
    table.add<3>("dense", seed, methods, forest_world(seed, kDenseForest), TableOptions());
  }
  int number = 0;
  for (const BenchmarkWorld<3>& world : built_worlds())
    table.add<3>("built", ++number, methods, world, TableOptions());
  std::printf("],\n\"fast\": [");
  Rows fast;
  for (int seed = first; seed <= last; ++seed) {
    const BenchmarkWorld<2> world = circle_world(seed, kCircles);
    fast.add<2>("open", seed, {{"camouflage", 5.0}}, world, fast_options(3.0, 2.0));
    fast.add<2>("open", seed, {{"camouflage", 5.0}}, world, fast_options(12.0, 5.0));
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  const int worlds = argc > 1 ? std::atoi(argv[1]) : 20;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  mocha::run(first, first + worlds - 1);
}
