#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/block_tridiagonal.h"
#include "optimization/time_quadrature.h"

namespace mocha {

/// A positive definite model of how the gradient of a TrajectoryObjective changes, for solvers to
/// take steps by: its Gauss-Newton Hessian as if the derivatives at the knots were free, which
/// makes it block-tridiagonal, with these derivatives eliminated. Factoring and solving take O(M);
/// after construction nothing is allocated.
template <int D, int S>
class CurvatureModel {
 public:
  using PieceCurvature = typename TimeQuadrature<D, S>::PieceCurvature;

  /// Of one piece more than knots; `per_knot[k]` variables place knot k, at most D.
  explicit CurvatureModel(std::vector<int> per_knot);

  void clear();

  /// Adds that of piece i, by the derivatives at its ends and by its duration. `tangents` (D x
  /// variables of all knots) are the derivatives of the knots by their variables, `slope` that of
  /// the duration by its own.
  void add(int i, const PieceCurvature& piece,
           const Eigen::Matrix<double, D, Eigen::Dynamic>& tangents, double slope);

  /// Adds damping * I and factors. False where that is not positive definite.
  bool factor(double damping);

  /// x becomes the inverse of the model times x; x holds the variables of the knots, then one a
  /// piece.
  void solve(Eigen::VectorXd& x);

 private:
  static constexpr int kEnd = S * D;  // entries of a knot's state; the duration follows
  static constexpr int kSize = kEnd + 1;

  int pieces() const { return matrix_.blocks(); }

  std::vector<int> per_knot_;
  std::vector<int> first_;          // variable of each knot, and of the durations
  BlockTridiagonal<kSize> matrix_;  // block i: the end of piece i, and its duration
  Eigen::Matrix<double, kSize, Eigen::Dynamic> columns_;
};

extern template class CurvatureModel<2, 3>;
extern template class CurvatureModel<3, 3>;

}  // namespace mocha
