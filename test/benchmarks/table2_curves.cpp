// The drives of Table II in one world, to be drawn as the paper's Figs. 8 and 9. Prints JSON; the
// argument is the world's seed.

#include <cstdlib>

#include "benchmarks/curve_json.h"
#include "benchmarks/ompl_peers.h"
#include "benchmarks/table2_mocha.h"

namespace mocha {
namespace {

Eigen::MatrixXd obstacle_columns(const Table2World& world) {
  Eigen::MatrixXd columns(3, world.circles.size());
  for (int i = 0; i < columns.cols(); ++i) {
    columns.col(i) << world.circles[i].centre, world.circles[i].radius_m;
  }
  return columns;
}

/// One trajectory of a figure: what was planned, or a candidate that was not chosen.
void print_drive(int target, const char* method, const Table2World& world,
                 const PlanarPath& curve) {
  if (curve.pieces() == 0) return;
  static bool first = true;
  std::printf("%s{\"target\": %d, \"method\": \"%s\", \"feasible\": %s", first ? "" : ",\n", target,
              method, measure(curve, world).feasible ? "true" : "false");
  print_columns("samples", samples<2>(curve));
  std::printf("}");
  first = false;
}

void print_drives(int number, const Table2World& world, const Vector2& target) {
  const Table2Plan mocha = plan_with_mocha(world, target);
  for (const PlanarPath& curve : mocha.candidates) print_drive(number, "candidate", world, curve);
  print_drive(number, "mocha", world, mocha.curve);
  const auto sst = [&](std::optional<double> budget_s) {
    return plan_with_sst(world, target, budget_s, Overspeed::kForbidden).curve;
  };
  print_drive(number, "sst_first", world, sst(std::nullopt));
  print_drive(number, "sst_1.5s", world, sst(1.5));
  print_drive(number, "bitstar_0.1s", world, plan_with_bitstar(world, target, 0.1).curve);
}

void run(int seed) {
  set_up_ompl();
  const Table2World world = table2_world(seed);
  std::printf("{\"world\": %d, \"max_speed\": %g, \"max_acceleration\": %g", seed,
              Table2Robot::kMaxSpeed, Table2Robot::kMaxAcceleration);
  print_columns("obstacles", obstacle_columns(world));
  Eigen::MatrixXd targets(2, world.targets.size());
  for (int i = 0; i < targets.cols(); ++i) targets.col(i) = world.targets[i];
  print_columns("start", world.start);
  print_columns("targets", targets);
  std::printf(",\n\"drives\": [");
  for (int i = 0; i < targets.cols(); ++i) print_drives(i + 1, world, world.targets[i]);
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { mocha::run(argc > 1 ? std::atoi(argv[1]) : 1); }
