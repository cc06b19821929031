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
/// After construction and resize() nothing is allocated.
template <int D, int S>
class TimeQuadrature {
 public:
  using Piece = typename Minco<D, S>::Piece;
  using Penalties = std::vector<std::unique_ptr<Penalty<D>>>;
  /// By the derivatives 0 .. S-1 at the start of a piece, those at its end, and its duration; the
  /// coordinates of each together.
  using PieceCurvature = Eigen::Matrix<double, 2 * S * D + 1, 2 * S * D + 1>;

  /// kappa >= 1, pieces >= 1, and the number of penalties of the calls to come.
  TimeQuadrature(int kappa, int pieces, std::size_t penalties);

  /// For another number of pieces from now on.
  void resize(int pieces);

  /// Returns the integral, adds the gradients, and adds each penalty's own share to `shares` (one
  /// entry a penalty).
  double add(const Minco<D, S>& curve, const Penalties& penalties, std::vector<Piece>& by_piece,
             Eigen::VectorXd& by_duration, std::vector<double>& shares);

  /// Of all penalties over piece i, at the last add().
  double integral(int i) const { return integrals_[i]; }

  /// The Gauss-Newton Hessian of the integral over piece i, which begins at `start_s`, plus that of
  /// `effort_weight` times the piece's effort. It is that of a sum of cubes, as most penalties are,
  /// paper (31): f = w g^3 has 6 w g times the square of g's gradient, or 2 / (3 f) times that of
  /// f's. How absolute time matters to penalties is left out.
  const PieceCurvature& curvature(const Minco<D, S>& curve, const Penalties& penalties,
                                  double effort_weight, int i, double start_s);

 private:
  using Basis = Eigen::Matrix<double, Eigen::Dynamic, 2 * S>;
  using Ends = Eigen::Matrix<double, D, 2 * S>;  // derivatives by normalised time
  using EndTable = Eigen::Matrix<double, 2 * S, 2 * S>;
  using Gradient = Eigen::Matrix<double, 2 * S * D + 1, 1>;

  void set_end_tables();
  Derivatives choose(const Penalties& penalties);
  void sample(const Piece& coefficients, Derivatives wanted);
  double penalise(const Penalties& penalties, std::vector<double>& shares);
  double propagate(Derivatives wanted, Piece& by_coefficients);
  void add_penalty_curvature(const Penalty<D>& penalty, Derivatives wanted, const Ends& ends);
  void add_effort_curvature(double weight, const Ends& ends);

  int kappa_;
  Eigen::VectorXd alpha_;                      // j / kappa
  Eigen::VectorXd omega_;                      // of the trapezoid rule, 1/2 at the ends
  std::array<Basis, kOrders> basis_;           // derivatives of u^k by u, a row a sample
  std::array<Basis, kOrders> weighted_basis_;  // times omega
  EndTable ends_by_coefficients_;
  EndTable effort_by_ends_;
  std::array<Basis, kOrders> basis_by_ends_;  // times the derivatives at the ends
  PieceSamples<D> samples_;
  PenaltyRows<D> rows_;
  PieceCurvature curvature_;
  std::vector<std::size_t> active_;  // penalties on the piece at hand
  std::vector<double> integrals_;    // over each piece
  std::vector<double> by_time_;      // of each piece as a whole
};

extern template class TimeQuadrature<2, 3>;
extern template class TimeQuadrature<3, 3>;

}  // namespace mocha
