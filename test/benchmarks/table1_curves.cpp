// The trajectories of Table I in one world of the plane and one of space, to be drawn as the
// paper's Figs. 6 and 7. Prints JSON; the argument is the seed of both worlds.

#include <cstdio>
#include <cstdlib>

#include "benchmarks/curve_json.h"
#include "benchmarks/table_plan.h"

namespace mocha {
namespace {

struct Choice {
  bool camouflage;
  double spacing_m;
};
constexpr Choice kChoices[] = {{false, 1.0}, {true, 1.0}, {false, 8.0}, {true, 8.0}};

/// Centre and radius of each, over the ground.
template <int D>
Eigen::MatrixXd obstacle_columns(const BenchmarkWorld<D>& world) {
  const auto& field = dynamic_cast<const PrimitiveField<D>&>(*world.field);
  Eigen::MatrixXd columns(3, field.primitives().size());
  for (int i = 0; i < columns.cols(); ++i) {
    const auto& primitive = field.primitives()[i];
    if constexpr (D == 2) {
      const Circle& circle = std::get<Circle>(primitive);
      columns.col(i) << circle.centre, circle.radius_m;
    } else {
      columns.col(i) << primitive.centre, primitive.radius_m;
    }
  }
  return columns;
}

/// The interior knots.
template <int D>
Eigen::MatrixXd knot_columns(const PiecewisePolynomial<D, 3>& curve) {
  Eigen::MatrixXd columns(D, curve.pieces() - 1);
  for (int i = 1; i < curve.pieces(); ++i) {
    columns.col(i - 1) << curve.position(curve.piece_start(i));
  }
  return columns;
}

template <int D>
void print_trajectory(const BenchmarkWorld<D>& world, const Choice& choice) {
  const TableOptions options;
  const TablePlan<D> planned = plan<D>(world, choice.spacing_m, choice.camouflage, options);
  std::printf("{\"method\": \"%s\", \"spacing_m\": %g, \"feasible\": %s",
              choice.camouflage ? "camouflage" : "minco", choice.spacing_m,
              planned.feasible ? "true" : "false");
  if (choice.camouflage) {
    const InitialKnots<D> knots = knots_on<D>(world.path, choice.spacing_m, options);
    print_columns("references", table_references<D>(world, knots, options));
  }
  print_columns("knots", knot_columns<D>(planned.curve));
  print_columns("samples", samples<D>(planned.curve));
  std::printf("}");
}

template <int D>
void print_scene(const char* key, int seed, const BenchmarkWorld<D>& world) {
  Eigen::MatrixXd front_end(D, world.path.size());
  for (int i = 0; i < front_end.cols(); ++i) front_end.col(i) = world.path[i];
  std::printf(",\n\"%s\": {\"world\": %d, \"dim\": %d", key, seed, D);
  print_columns("obstacles", obstacle_columns<D>(world));
  print_columns("front_end", front_end);
  std::printf(",\n\"trajectories\": [");
  for (const Choice& choice : kChoices) {
    if (&choice != kChoices) std::printf(",\n");
    print_trajectory<D>(world, choice);
  }
  std::printf("]}");
}

void run(int seed) {
  const TableOptions options;
  std::printf("{\"max_speed\": %g, \"max_acceleration\": %g", options.max_speed,
              options.max_acceleration);
  print_scene<2>("plane", seed, circle_world(seed, kCircles));
  print_scene<3>("space", seed, forest_world(seed, kForest));
  std::printf("}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { mocha::run(argc > 1 ? std::atoi(argv[1]) : 1); }
