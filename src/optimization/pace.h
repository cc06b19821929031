#pragma once

#include <algorithm>
#include <cmath>

#include "optimization/trajectory_objective.h"

namespace mocha {

/// Durations times the factor >= 1 at which the objective's cost is about least, its knots being
/// where they begin: effort falls with the factor's power 2S - 1, and the rest of the cost is taken
/// to grow with it as fast as it does now. Durations of a front-end are the least that the limits
/// allow, while effort may ask for twice that, and L-BFGS needs many evaluations to find it.
template <int D, int S>
Eigen::VectorXd paced(TrajectoryObjective<D, S>& objective, const Eigen::VectorXd& durations_s) {
  constexpr int kPasses = 2;  // limits that are exceeded in the first pass hide the other penalties
  constexpr int kPower = 2 * S - 1;
  Eigen::VectorXd gradient(objective.variables());
  double factor = 1.0;
  for (int pass = 0; pass < kPasses; ++pass) {
    objective.evaluate(objective.initial(factor * durations_s), gradient);
    const double falling = kPower * objective.effort();
    const double growing = std::max(objective.duration_cost(), objective.by_pace() + falling);
    const double next = factor * std::pow(falling / growing, 1.0 / (kPower + 1));
    if (std::isfinite(next)) factor = std::max(1.0, next);
  }
  return factor * durations_s;
}

}  // namespace mocha
