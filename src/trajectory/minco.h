#pragma once

#include <Eigen/Core>
#include <vector>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// The minimum-control-effort curve, paper (5), through given knots at given durations, and the way
/// back for gradients.
///
/// The unknowns are the derivatives 1 .. S-1 at the interior knots. The effort is a quadratic form
/// in them whose matrix is block-tridiagonal and positive definite (the banded system, paper
/// (6)(10), after eliminating the coefficients), so one elimination gives the curve and the same
/// factors give the adjoint, both in O(M) and without pivoting.
///
/// All storage is sized by resize(); after it, nothing allocates. The arithmetic has a fixed order
/// and fuses nothing, so that every machine gets the same bits from the same numbers.
template <int D, int S>
class Minco {
 public:
  static constexpr int kFree = S - 1;  ///< unknown derivatives per axis and knot
  using Curve = PiecewisePolynomial<D, S>;
  using State = typename Curve::State;
  using Piece = typename Curve::Piece;
  using Knots = Eigen::Matrix<double, D, Eigen::Dynamic>;

  /// Prepares for M = `pieces` >= 1 pieces.
  void resize(int pieces);
  int pieces() const { return static_cast<int>(tau_.size()); }

  /// Solves for the curve. `knots` is D x (M-1) [m]; `durations_s` has M positive entries. Sizes
  /// must match resize().
  void solve(const State& start, const State& end, const Knots& knots,
             const Eigen::VectorXd& durations_s);

  const Piece& piece(int i) const { return pieces_[i]; }
  double piece_duration(int i) const { return tau_[i]; }
  Curve curve() const;

  /// Control effort, paper (27) [m^2/s^(2S-1)].
  double effort() const;

  /// Adds weight times the gradient of the effort to partial gradients as propagate() takes them.
  void add_effort_gradient(double weight, std::vector<Piece>& by_piece,
                           Eigen::VectorXd& by_duration) const;

  /// Maps the gradient of any J(pieces, durations) to (knots, durations): on entry `by_piece[i]` is
  /// dJ/d(piece(i)) and `by_duration` dJ/d(tau) at fixed (normalised) coefficients; on return
  /// `by_duration` and `by_knot` are total.
  void propagate(const std::vector<Piece>& by_piece, Eigen::VectorXd& by_duration, Knots& by_knot);

 private:
  static constexpr int kRows = D + D % 2;  // whole SIMD packets; an odd last row stays zero
  using Block = Eigen::Matrix<double, kFree, kFree>;
  using Column = Eigen::Matrix<double, kRows, 1>;
  using Free = Eigen::Matrix<double, kRows, kFree>;     // columns: derivatives 1 .. S-1
  using Derivatives = Eigen::Matrix<double, kRows, S>;  // columns: derivatives 0 .. S-1

  void eliminate();
  void shape(int i);
  void pull_back(const std::vector<Piece>& by_piece, Eigen::VectorXd& by_duration, Knots& by_knot);

  std::vector<Derivatives> states_;  // M+1 knots
  std::vector<Piece> pieces_;        // M
  std::vector<double> tau_;          // M
  std::vector<double> rate_;         // M: 1 / tau
  std::vector<Derivatives> forces_;  // M: half the effort's derivative by a piece's normalised end
  std::vector<double> efforts_;      // M
  // The factor at each knot: the inverse of its diagonal block, and the block below that, times it.
  // Both are zero at the first knot, where nothing is free.
  std::vector<Block> inverse_;  // M
  std::vector<Block> below_;    // M
  std::vector<Free> adjoint_;   // M
};

extern template class Minco<2, 2>;
extern template class Minco<2, 3>;
extern template class Minco<2, 4>;
extern template class Minco<3, 2>;
extern template class Minco<3, 3>;
extern template class Minco<3, 4>;

using PlanarMinco = Minco<2, 3>;

}  // namespace mocha
