// The paper's Table II: this package's planner against SST and BIT* of OMPL, on the way to three
// targets through worlds of circles. Then SST with its speed clipped. Prints JSON; the argument is
// the number of worlds.

#include <cstdio>
#include <cstdlib>

#include "benchmarks/ompl_peers.h"
#include "benchmarks/table2_mocha.h"

namespace mocha {
namespace {

constexpr double kSstBudget_s = 1.5;
constexpr double kBitstarBudget_s = 0.1;

/// One task of the table, and the rows it gives.
class Task {
 public:
  Task(int seed, int target) : seed_(seed), target_(target), world_(table2_world(seed)) {}

  const Table2World& world() const { return world_; }
  const Vector2& target() const { return world_.targets[target_ - 1]; }

  void print_sst(Overspeed overspeed) const {
    print("sst_first", plan_with_sst(world_, target(), std::nullopt, overspeed));
    std::printf(",");
    print("sst_1.5s", plan_with_sst(world_, target(), kSstBudget_s, overspeed));
  }

  void print(const char* method, const Table2Plan& plan) const {
    std::printf(
        "\n  {\"world\": %d, \"target\": %d, \"method\": \"%s\", \"t_plan_s\": %.5g, "
        "\"classes\": %d, ",
        seed_, target_, method, plan.t_plan_s, plan.classes);
    if (plan.curve.pieces() == 0) {
      std::printf(
          "\"L_m\": null, \"T_s\": null, \"v_max\": null, \"v_avg\": null, "
          "\"T_over_kinematic_limit\": null, \"feasible\": false}");
      return;
    }
    const Table2Measures found = measure(plan.curve, world_);
    std::printf(
        "\"L_m\": %.5g, \"T_s\": %.5g, \"v_max\": %.4g, \"v_avg\": %.4g, "
        "\"T_over_kinematic_limit\": %.5g, \"feasible\": %s}",
        found.length_m, found.duration_s, found.top_speed, found.mean_speed,
        found.duration_s / found.kinematic_s, found.feasible ? "true" : "false");
  }

 private:
  const int seed_;
  const int target_;  // from 1 on
  const Table2World world_;
};

/// A list of rows: what `print` prints of each task.
template <typename Print>
void print_list(const char* key, int worlds, const Print& print) {
  std::printf("\"%s\": [", key);
  for (int seed = 1; seed <= worlds; ++seed) {
    for (const int target : {1, 2, 3}) {
      if (seed > 1 || target > 1) std::printf(",");
      print(Task(seed, target));
    }
  }
  std::printf("]");
}

void run(int worlds) {
  set_up_ompl();
  std::printf("{");
  print_list("rows", worlds, [](const Task& task) {
    task.print("mocha", plan_with_mocha(task.world(), task.target()));
    std::printf(",");
    task.print_sst(Overspeed::kForbidden);
    std::printf(",");
    task.print("bitstar_first", plan_with_bitstar(task.world(), task.target(), std::nullopt));
    std::printf(",");
    task.print("bitstar_0.1s", plan_with_bitstar(task.world(), task.target(), kBitstarBudget_s));
  });
  std::printf(",\n");
  print_list("clipped", worlds, [](const Task& task) { task.print_sst(Overspeed::kClipped); });
  std::printf("}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { mocha::run(argc > 1 ? std::atoi(argv[1]) : 10); }
