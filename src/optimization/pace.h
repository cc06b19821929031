#pragma once

#include <algorithm>
#include <cmath>

#include "optimization/trajectory_objective.h"

namespace mocha {

/// Durations times the factor at which the objective's cost is about least, its knots being where
/// they begin: effort falls with the factor's power 2S - 1, and the rest of the cost is taken to
/// grow with it as fast as it does now. A front-end's durations come from limits of speed, while
/// effort may ask for half that pace; L-BFGS would need a hundred evaluations to find that.
template <int D, int S>
Eigen::VectorXd paced(TrajectoryObjective<D, S>& objective, Eigen::VectorXd durations_s) {
  constexpr int kPasses = 2;  // limits of speed are exceeded in the first, and hide the rest
  constexpr int kPower = 2 * S - 1;
  Eigen::VectorXd gradient(objective.variables());
  for (int pass = 0; pass < kPasses; ++pass) {
    objective.evaluate(objective.initial(durations_s), gradient);
    const double falling = kPower * objective.effort();
    const double growing = std::max(objective.duration_cost(), objective.by_pace() + falling);
    const double factor = std::pow(falling / growing, 1.0 / (kPower + 1));
    if (std::isfinite(factor) && factor > 0.0) durations_s *= factor;
  }
  return durations_s;
}

}  // namespace mocha
