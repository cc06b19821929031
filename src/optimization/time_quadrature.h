#pragma once

#include <array>
#include <memory>
#include <vector>

#include "optimization/penalty.h"
#include "trajectory/minco.h"

namespace mocha {

/// Integrates penalties over a trajectory by the trapezoid rule with kappa intervals a piece, paper
/// (21), and their gradient by the pieces' normalised coefficients and durations, paper (23)-(26).
///
/// Exact with respect to that rule, but pieces on which a penalty is certainly zero are skipped.
/// After construction nothing is allocated.
template <int D, int S>
class TimeQuadrature {
 public:
  using Piece = typename Minco<D, S>::Piece;
  using Penalties = std::vector<std::unique_ptr<Penalty<D>>>;

  /// kappa >= 1, pieces >= 1, and the number of penalties of the calls to come.
  TimeQuadrature(int kappa, int pieces, std::size_t penalties);

  /// Returns the integral, adds the gradients, and adds each penalty's own share to `shares` (one
  /// entry a penalty).
  double add(const Minco<D, S>& curve, const Penalties& penalties, std::vector<Piece>& by_piece,
             Eigen::VectorXd& by_duration, std::vector<double>& shares);

 private:
  using Basis = Eigen::Matrix<double, Eigen::Dynamic, 2 * S>;

  Derivatives choose(const Penalties& penalties);
  void sample(const Piece& coefficients, Derivatives wanted);
  double penalise(const Penalties& penalties, std::vector<double>& shares);
  double propagate(Derivatives wanted, Piece& by_coefficients);

  int kappa_;
  Eigen::VectorXd alpha_;                      // j / kappa
  Eigen::VectorXd omega_;                      // of the trapezoid rule, 1/2 at the ends
  std::array<Basis, kOrders> basis_;           // derivatives of u^k by u, a row a sample
  std::array<Basis, kOrders> weighted_basis_;  // times omega
  PieceSamples<D> samples_;
  PenaltyRows<D> rows_;
  std::vector<std::size_t> active_;  // penalties on the piece at hand
  std::vector<double> by_time_;      // of each piece as a whole
};

extern template class TimeQuadrature<2, 2>;
extern template class TimeQuadrature<2, 3>;
extern template class TimeQuadrature<2, 4>;
extern template class TimeQuadrature<3, 2>;
extern template class TimeQuadrature<3, 3>;
extern template class TimeQuadrature<3, 4>;

}  // namespace mocha
