#pragma once

#include <functional>
#include <optional>

#include "optimization/knot_chain.h"
#include "optimization/trajectory_objective.h"

namespace mocha {

/// A front-end path with knots to choose from.
template <int D>
struct KnotCandidates {
  using Points = Eigen::Matrix<double, D, Eigen::Dynamic>;

  Points path;         ///< start, knots at uniform time, end [m]: `coarsest` x n + 1 columns
  double duration_s;   ///< of the path, about
  int coarsest;        ///< intervals of the path in the longest pieces, a power of 2
  double tolerance_m;  ///< by which the curve may begin beside the path
  /// The reference points of knots on a path of start, knots and end; nothing where there are none,
  /// and knots become waypoints.
  std::function<std::optional<Points>(const Points& path)> references;
};

/// Few knots of the path, at a good pace: the coarsest pieces are halved where their curve leaves
/// the path, or where it is penalised more than one through all candidates. Throws
/// std::invalid_argument for candidates that are not as described.
template <int D>
KnotChain<D> choose_knots(TrajectoryObjective<D, 3>& objective,
                          const KnotCandidates<D>& candidates);

extern template KnotChain<2> choose_knots(TrajectoryObjective<2, 3>&, const KnotCandidates<2>&);
extern template KnotChain<3> choose_knots(TrajectoryObjective<3, 3>&, const KnotCandidates<3>&);

}  // namespace mocha
