#include "optimization/trajectory_optimizer.h"

#include <LBFGS.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace mocha {
namespace {

constexpr int kCostWindow = 5;  // iterations over which the fall of the cost is looked at
constexpr double kRelativeGradient = 1e-5;  // smaller, the search has converged

/// Thrown through the solver, which offers no other way to leave it between two evaluations.
struct EndSearch {
  StopReason reason;
};

/// Counts evaluations, remembers the best variables, and ends the search by the caller's rules.
template <int D, int S>
class WatchedObjective {
 public:
  WatchedObjective(TrajectoryObjective<D, S>& objective, const OptimizerOptions& options)
      : objective_(objective), options_(options) {}

  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    if (evaluations_ >= options_.max_evaluations) throw EndSearch{StopReason::kBudget};
    if (options_.should_stop()) throw EndSearch{StopReason::kStopped};
    ++evaluations_;
    const double cost = objective_.evaluate(x, gradient);
    if (!std::isfinite(cost) || !gradient.allFinite()) {
      // Too long a step; a large finite value makes the line search come back.
      gradient.setZero();
      return kFarAway;
    }
    if (cost < best_cost_) {
      best_cost_ = cost;
      best_ = x;
    }
    return cost;
  }

  int evaluations() const { return evaluations_; }
  double best_cost() const { return best_cost_; }
  const Eigen::VectorXd& best() const { return best_; }

 private:
  static constexpr double kFarAway = 1e30;
  TrajectoryObjective<D, S>& objective_;
  const OptimizerOptions& options_;
  int evaluations_ = 0;
  double best_cost_ = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best_;
};

LBFGSpp::LBFGSParam<double> solver_parameters(const OptimizerOptions& options) {
  LBFGSpp::LBFGSParam<double> parameters;
  parameters.m = 12;
  parameters.epsilon = kRelativeGradient;
  parameters.epsilon_rel = kRelativeGradient;
  parameters.past = kCostWindow;
  parameters.delta = options.relative_cost;
  parameters.max_iterations = 0;  // the number of evaluations is what counts
  parameters.max_linesearch = 30;
  parameters.linesearch = LBFGSpp::LBFGS_LINESEARCH_BACKTRACKING_WOLFE;
  return parameters;
}

}  // namespace

template <int D, int S>
OptimizedTrajectory<D, S> optimize(TrajectoryObjective<D, S>& objective, Eigen::VectorXd x,
                                   const OptimizerOptions& options) {
  OptimizedTrajectory<D, S> result;
  WatchedObjective<D, S> watched(objective, options);
  const LBFGSpp::LBFGSParam<double> parameters =
      solver_parameters(options);  // the solver refers to it
  LBFGSpp::LBFGSSolver<double, LBFGSpp::LineSearchBracketing> solver(parameters);
  try {
    double cost;
    solver.minimize(watched, x, cost);
    result.stop = StopReason::kConverged;
  } catch (const EndSearch& end) {
    result.stop = end.reason;
  } catch (const std::runtime_error&) {
    result.stop = StopReason::kLineSearchEnded;
  } catch (const std::logic_error&) {  // the direction did not descend: rounding
    result.stop = StopReason::kLineSearchEnded;
  }
  result.evaluations = watched.evaluations();
  result.cost = watched.best_cost();
  if (!std::isfinite(result.cost)) {
    if (result.evaluations > 0) result.stop = StopReason::kNotFinite;
    return result;
  }
  Eigen::VectorXd gradient(objective.variables());
  objective.evaluate(watched.best(), gradient);
  result.terms = objective.terms();
  result.curve = objective.curve();
  result.variables = watched.best();
  return result;
}

template OptimizedTrajectory<2, 2> optimize(TrajectoryObjective<2, 2>&, Eigen::VectorXd,
                                            const OptimizerOptions&);
template OptimizedTrajectory<2, 3> optimize(TrajectoryObjective<2, 3>&, Eigen::VectorXd,
                                            const OptimizerOptions&);
template OptimizedTrajectory<2, 4> optimize(TrajectoryObjective<2, 4>&, Eigen::VectorXd,
                                            const OptimizerOptions&);
template OptimizedTrajectory<3, 2> optimize(TrajectoryObjective<3, 2>&, Eigen::VectorXd,
                                            const OptimizerOptions&);
template OptimizedTrajectory<3, 3> optimize(TrajectoryObjective<3, 3>&, Eigen::VectorXd,
                                            const OptimizerOptions&);
template OptimizedTrajectory<3, 4> optimize(TrajectoryObjective<3, 4>&, Eigen::VectorXd,
                                            const OptimizerOptions&);

}  // namespace mocha
