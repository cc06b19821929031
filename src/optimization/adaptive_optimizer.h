#pragma once

#include "optimization/knot_choice.h"
#include "optimization/trajectory_optimizer.h"

namespace mocha {

template <int D>
struct AdaptiveTrajectory {
  /// Its evaluations are those of all searches; those by which knots are chosen, paced and tried,
  /// about ten, come on top.
  OptimizedTrajectory<D, 3> found;
  KnotChain<D> chain;          ///< of the curve that was found
  long piece_evaluations = 0;  ///< evaluations times pieces, of all rounds
};

/// Minimises the objective over knots whose number and freedom it finds as well: few, each on its
/// ray, are optimised roughly from a well-paced start; then refine() adds and removes what is worth
/// it, and the search goes on from the curve in hand, ever finer, until it ends by the caller's
/// rules and nothing of worth is left to add. Whatever knots the objective has are replaced.
/// `travel_m` is that of AdaptiveMap.
template <int D>
AdaptiveTrajectory<D> optimize_adaptively(TrajectoryObjective<D, 3>& objective,
                                          const KnotCandidates<D>& candidates, double travel_m,
                                          const OptimizerOptions& options);

extern template AdaptiveTrajectory<2> optimize_adaptively(TrajectoryObjective<2, 3>&,
                                                          const KnotCandidates<2>&, double,
                                                          const OptimizerOptions&);
extern template AdaptiveTrajectory<3> optimize_adaptively(TrajectoryObjective<3, 3>&,
                                                          const KnotCandidates<3>&, double,
                                                          const OptimizerOptions&);

}  // namespace mocha
