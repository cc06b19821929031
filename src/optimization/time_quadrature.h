#pragma once

#include <memory>
#include <vector>

#include "optimization/penalty.h"
#include "trajectory/minco.h"

namespace mocha {

/// Integrates penalties over a trajectory by the trapezoid rule with kappa intervals a piece (21),
/// and their gradient by the pieces' normalised coefficients and durations (23)-(26).
template <int D, int S>
class TimeQuadrature {
 public:
  using Piece = typename Minco<D, S>::Piece;

  /// kappa >= 1.
  explicit TimeQuadrature(int kappa);

  /// Returns the integral, adds the gradients, and adds each penalty's own share to `shares` (one
  /// entry a penalty).
  double add(const Minco<D, S>& curve, const std::vector<std::unique_ptr<Penalty<D>>>& penalties,
             std::vector<Piece>& by_piece, Eigen::VectorXd& by_duration,
             std::vector<double>& shares) const;

 private:
  using Basis = Eigen::Matrix<double, 2 * S, 1>;
  int kappa_;
  std::vector<Basis> value_;  // u^k at each sample
  std::vector<Basis> first_;  // derivative by u
  std::vector<Basis> second_;
  std::vector<Basis> third_;
};

extern template class TimeQuadrature<2, 3>;
extern template class TimeQuadrature<3, 3>;

}  // namespace mocha
