#pragma once

#include "optimization/knot_chain.h"
#include "optimization/trajectory_objective.h"

namespace mocha {

/// What a curve would gain by one more knot in the middle of each piece, and by more variables of
/// the knots that it has.
template <int D>
struct TrialKnots {
  using Points = Eigen::Matrix<double, D, Eigen::Dynamic>;

  double cost;  ///< of the curve, with penalties sampled twice as densely
  typename Minco<D, 3>::Curve curve;
  Points middles;                  ///< of the pieces [m]
  Points by_middle;                ///< gradient of the cost
  Points by_knot;                  ///< the same
  std::vector<bool> is_free;       ///< of each piece: no penalty
  std::vector<double> knot_gains;  ///< of the cost: of a knot in each piece
  std::vector<double> axis_gains;  ///< of one more variable for each knot
};

/// Tries a knot in the middle of each piece: that leaves a MINCO curve as it is, so a single
/// evaluation tells the gradients g there. A knot is worth g^2 / (2 H), where H is how stiff effort
/// makes the curve, and the error of the samples that it would double. `penalties` are those of the
/// pieces as they were sampled; the objective's knot map is replaced.
template <int D>
TrialKnots<D> try_knots(TrajectoryObjective<D, 3>& objective, const KnotChain<D>& chain,
                        const typename Minco<D, 3>::Curve& curve,
                        const std::vector<double>& penalties);

/// Adds the knots and variables that are worth most, until what is left out is not worth more than
/// `share` of the cost, and removes idle knots: those away from penalties that hardly bend the
/// curve. New knots are on the curve, on rays down the gradient across it. Returns whether
/// anything was added.
template <int D>
bool refine(KnotChain<D>& chain, const TrialKnots<D>& trial, double share);

extern template TrialKnots<2> try_knots(TrajectoryObjective<2, 3>&, const KnotChain<2>&,
                                        const Minco<2, 3>::Curve&, const std::vector<double>&);
extern template TrialKnots<3> try_knots(TrajectoryObjective<3, 3>&, const KnotChain<3>&,
                                        const Minco<3, 3>::Curve&, const std::vector<double>&);
extern template bool refine(KnotChain<2>&, const TrialKnots<2>&, double);
extern template bool refine(KnotChain<3>&, const TrialKnots<3>&, double);

}  // namespace mocha
