#include "optimization/trajectory_optimizer.h"

#include <LBFGS.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "optimization/lbfgs_pairs.h"

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

/// Descends by L-BFGS from a model of the curvature that is made anew every few steps.
template <int D, int S>
class Descent {
 public:
  Descent(TrajectoryObjective<D, S>& objective, WatchedObjective<D, S>& watched,
          const OptimizerOptions& options)
      : objective_(objective),
        watched_(watched),
        options_(options),
        pairs_(objective.variables()),
        gradient_(objective.variables()),
        next_gradient_(objective.variables()),
        step_(objective.variables()),
        next_(objective.variables()) {}

  StopReason run(Eigen::VectorXd x) {
    cost_ = watched_(x, gradient_);
    std::array<double, kCostWindow> before;
    for (int iteration = 0;; ++iteration) {
      if (gradient_.norm() <= kRelativeGradient * std::max(1.0, x.norm()))
        return StopReason::kConverged;
      if (iteration % kModelAge == 0 && !renew_model()) return StopReason::kLineSearchEnded;
      double& oldest = before[iteration % kCostWindow];
      if (iteration >= kCostWindow &&
          oldest - cost_ <= options_.relative_cost * std::max(1.0, std::abs(cost_)))
        return StopReason::kConverged;
      oldest = cost_;
      if (!choose_step() || !search_along(x)) return StopReason::kLineSearchEnded;
    }
  }

 private:
  /// Where it says nothing of a variable, a step changes that by a unit at most: 1 m.
  bool renew_model() {
    double damping = gradient_.cwiseAbs().maxCoeff();
    for (int attempt = 0; attempt < kModels; ++attempt, damping *= kMoreDamping) {
      if (objective_.prepare_steps(damping)) return true;
    }
    return false;
  }

  /// False where there is no way down.
  bool choose_step() {
    for (int attempt = 0; attempt < 2; ++attempt) {
      step_ = gradient_;
      pairs_.to_step(step_, [this](Eigen::VectorXd& inner) { objective_.to_step(inner); });
      step_ = -step_;
      slope_ = step_.dot(gradient_);
      if (slope_ < 0.0) return true;
      pairs_.clear();
    }
    return false;
  }

  /// Goes as far along the step as meets the weak Wolfe conditions; false where nothing does.
  bool search_along(Eigen::VectorXd& x) {
    double low = 0.0;
    double high = std::numeric_limits<double>::infinity();
    double share = 1.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      next_ = x + share * step_;
      const double next_cost = watched_(next_, next_gradient_);
      if (next_cost > cost_ + kSufficient * share * slope_) {
        high = share;
        share = low > 0.0 ? 0.5 * (low + high) : share * shorter(share, next_cost);
      } else if (next_gradient_.dot(step_) < kLevel * slope_) {
        low = share;
        share = std::isinf(high) ? 2.0 * low : 0.5 * (low + high);
      } else {
        step_ *= share;
        gradient_ = next_gradient_ - gradient_;
        pairs_.add(step_, gradient_);
        x.swap(next_);
        gradient_.swap(next_gradient_);
        cost_ = next_cost;
        return true;
      }
    }
    return false;
  }

  /// By how much the minimum of the parabola through what is known is nearer.
  double shorter(double share, double next_cost) const {
    const double above = next_cost - cost_ - slope_ * share;
    return std::clamp(-0.5 * slope_ * share / above, 0.1, 0.5);
  }

  static constexpr int kModelAge = 4;  // steps; making the model takes several evaluations' time
  static constexpr int kModels = 6;
  static constexpr double kMoreDamping = 10.0;
  static constexpr int kTrials = 30;
  static constexpr double kSufficient = 1e-4;  // Armijo
  static constexpr double kLevel = 0.9;        // Wolfe

  TrajectoryObjective<D, S>& objective_;
  WatchedObjective<D, S>& watched_;
  const OptimizerOptions& options_;
  LbfgsPairs pairs_;
  double cost_ = 0.0;
  double slope_ = 0.0;  // of the cost along the step
  Eigen::VectorXd gradient_;
  Eigen::VectorXd next_gradient_;
  Eigen::VectorXd step_;
  Eigen::VectorXd next_;
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
    if (options.model_curvature) {
      result.stop = Descent<D, S>(objective, watched, options).run(std::move(x));
    } else {
      double cost;
      solver.minimize(watched, x, cost);
      result.stop = StopReason::kConverged;
    }
  } catch (const EndSearch& end) {
    result.stop = end.reason;
  } catch (const std::runtime_error&) {
    result.stop = StopReason::kLineSearchEnded;
  } catch (const std::logic_error&) {  // the direction did not descend: rounding
    result.stop = StopReason::kLineSearchEnded;
  }
  result.parameterisation = objective.parameterisation();
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

template OptimizedTrajectory<2, 3> optimize(TrajectoryObjective<2, 3>&, Eigen::VectorXd,
                                            const OptimizerOptions&);
template OptimizedTrajectory<3, 3> optimize(TrajectoryObjective<3, 3>&, Eigen::VectorXd,
                                            const OptimizerOptions&);

}  // namespace mocha
