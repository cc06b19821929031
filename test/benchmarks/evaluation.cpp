// Time of one evaluation of the objective against the spline and its adjoint alone: a path of about
// 146 m in 147 pieces, 65 circles, kappa = 20. Prints JSON.

#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>

#include "benchmarks/benchmark_problem.h"
#include "optimization/trajectory_optimizer.h"

namespace mocha {
namespace {

constexpr double kSpacing_m = 1.0;
constexpr int kRounds = 200;
constexpr int kRepetitions = 50;

double seconds_each(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kRepetitions; ++i) work();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  return taken.count() / kRepetitions;
}

/// Solves for the curve and maps the gradient of its effort and duration back to the knots.
class SplineAlone {
 public:
  SplineAlone(const TrajectoryObjective<2, 3>::Options& objective_options,
              const InitialKnots<2>& knots)
      : start_(objective_options.start),
        end_(objective_options.end),
        knots_(knots.path.middleCols(1, knots.path.cols() - 2)),
        durations_(knots.durations_s),
        by_piece_(durations_.size()),
        by_duration_(durations_.size()),
        by_knot_(knots_) {
    minco_.resize(static_cast<int>(durations_.size()));
  }

  void run() {
    minco_.solve(start_, end_, knots_, durations_);
    for (auto& piece : by_piece_) piece.setZero();
    by_duration_.setOnes();
    minco_.add_effort_gradient(1.0, by_piece_, by_duration_);
    minco_.propagate(by_piece_, by_duration_, by_knot_);
    sum_ += minco_.effort() + by_knot_(0, 0);
  }

  double sum() const { return sum_; }

 private:
  PlanarMinco minco_;
  PlanarMinco::State start_;
  PlanarMinco::State end_;
  PlanarMinco::Knots knots_;
  Eigen::VectorXd durations_;
  std::vector<PlanarMinco::Piece> by_piece_;
  Eigen::VectorXd by_duration_;
  PlanarMinco::Knots by_knot_;
  double sum_ = 0.0;
};

/// Where an optimisation is after a while: what evaluations are usually made of.
Eigen::VectorXd halfway(TrajectoryObjective<2, 3>& objective, const InitialKnots<2>& knots) {
  return optimize<2, 3>(objective, objective.initial(knots.durations_s),
                        {60, 1e-4, [] { return false; }})
      .variables;
}

void run() {
  const TableOptions options;
  std::printf("{\"rows\": [");
  for (const bool camouflage : {true, false}) {
    for (int seed = 1; seed <= 3; ++seed) {
      const BenchmarkWorld<2> world = circle_world(seed, kCircles);
      const InitialKnots<2> knots = knots_on<2>(world.path, kSpacing_m, options);
      auto objective_options = table_objective_options<2>(world, knots, camouflage, options);
      SplineAlone spline(objective_options, knots);
      TrajectoryObjective<2, 3> objective(std::move(objective_options));
      const Eigen::VectorXd x = halfway(objective, knots);
      Eigen::VectorXd gradient(x.size());
      double sum = 0.0;
      // Turn by turn, and the least of many: what else the machine does must not decide.
      double full_s = std::numeric_limits<double>::infinity();
      double spline_s = full_s;
      for (int round = 0; round < kRounds; ++round) {
        full_s = std::min(full_s, seconds_each([&] { sum += objective.evaluate(x, gradient); }));
        spline_s = std::min(spline_s, seconds_each([&] { spline.run(); }));
      }
      if (!std::isfinite(sum + spline.sum())) throw std::runtime_error("evaluation: not finite");
      const char* method = camouflage ? "camouflage" : "minco";
      for (const auto& [what, seconds] : {std::pair{"full", full_s}, {"spline", spline_s}}) {
        std::printf(
            "%s\n  {\"what\": \"%s\", \"method\": \"%s\", \"world\": %d, \"pieces\": %d, "
            "\"seconds\": %.4g}",
            camouflage && seed == 1 && what[0] == 'f' ? "" : ",", what, method, seed,
            objective.pieces(), seconds);
      }
    }
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main() { mocha::run(); }
