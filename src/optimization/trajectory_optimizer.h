#pragma once

#include <functional>

#include "optimization/trajectory_objective.h"

namespace mocha {

/// Why the optimiser stopped.
enum class StopReason {
  kConverged,        ///< cost or gradient settled
  kLineSearchEnded,  ///< no further descent in floating point
  kBudget,           ///< evaluations used up
  kStopped,          ///< the caller's should_stop said so
  kNotFinite,        ///< the cost was not finite at the start
  kInvalidInput      ///< the problem itself is not one: nothing was tried
};

struct OptimizerOptions {
  int max_evaluations;
  double relative_cost;  ///< stop when the cost falls by less than this share over 5 iterations
  std::function<bool()> should_stop;
  /// Whether steps are taken by a CurvatureModel besides: fewer, the more so the longer a
  /// trajectory is, though each takes longer.
  bool model_curvature = false;
};

template <int D, int S>
struct OptimizedTrajectory {
  StopReason stop = StopReason::kInvalidInput;
  Parameterisation parameterisation = Parameterisation::kNone;
  int evaluations = 0;
  double cost = 0.0;
  CostTerms terms;
  typename Minco<D, S>::Curve curve;  ///< the best one seen; empty if no cost was finite
  Eigen::VectorXd variables;          ///< of that curve
};

/// Minimises the objective by L-BFGS from `x`, with or without a model of the curvature. Returns
/// the best trajectory seen, whatever ended the search.
template <int D, int S>
OptimizedTrajectory<D, S> optimize(TrajectoryObjective<D, S>& objective, Eigen::VectorXd x,
                                   const OptimizerOptions& options);

extern template OptimizedTrajectory<2, 3> optimize(TrajectoryObjective<2, 3>&, Eigen::VectorXd,
                                                   const OptimizerOptions&);
extern template OptimizedTrajectory<3, 3> optimize(TrajectoryObjective<3, 3>&, Eigen::VectorXd,
                                                   const OptimizerOptions&);

}  // namespace mocha
