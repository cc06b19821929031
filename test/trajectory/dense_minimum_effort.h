#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "trajectory/minco_problem.h"

namespace mocha::test {

using Real = long double;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// d^order/du^order of u^power.
inline Real monomial_slope(int power, int order, Real u) {
  if (order > power) return 0.0;
  Real factor = 1.0;
  for (int j = 0; j < order; ++j) factor *= power - j;
  return factor * std::pow(u, static_cast<Real>(power - order));
}

/// The linear conditions on the normalised coefficients of all pieces: rows * coefficients =
/// values.
template <int D, int S>
class Conditions {
 public:
  explicit Conditions(const Problem<D, S>& problem)
      : problem_(problem), rows_(0, 2 * S * problem.pieces()), values_(0, D) {
    const int last = problem.pieces() - 1;
    for (int order = 0; order < S; ++order) {
      set(0, 0.0, order, problem.start.col(order));
      set(last, 1.0, order, problem.end.col(order));
    }
    for (int k = 0; k < last; ++k) {
      set(k, 1.0, 0, problem.knots.col(k));
      set(k + 1, 0.0, 0, problem.knots.col(k));
      for (int order = 1; order < S; ++order) join(k, order);
    }
  }
  const RealMatrix& rows() const { return rows_; }
  const RealMatrix& values() const { return values_; }

 private:
  int add() {
    rows_.conservativeResize(rows_.rows() + 1, Eigen::NoChange);
    values_.conservativeResize(values_.rows() + 1, Eigen::NoChange);
    rows_.row(rows_.rows() - 1).setZero();
    values_.row(values_.rows() - 1).setZero();
    return static_cast<int>(rows_.rows()) - 1;
  }
  void put(int row, int piece, Real u, int order, Real factor) {
    const Real scale = factor / std::pow(static_cast<Real>(problem_.durations[piece]), order);
    for (int j = 0; j < 2 * S; ++j) {
      rows_(row, 2 * S * piece + j) = scale * monomial_slope(j, order, u);
    }
  }
  template <typename Value>
  void set(int piece, Real u, int order, const Value& value) {
    const int row = add();
    put(row, piece, u, order, 1.0);
    values_.row(row) = value.transpose().template cast<Real>();
  }
  void join(int knot, int order) {
    const int row = add();
    put(row, knot, 1.0, order, 1.0);
    put(row, knot + 1, 0.0, order, -1.0);
  }

  const Problem<D, S>& problem_;
  RealMatrix rows_;
  RealMatrix values_;
};

/// Coefficients (2SM x D) of the curve of least effort among all C^(S-1) curves that meet the ends
/// and knots: a quadratic programme, solved densely by its optimality conditions in extended
/// precision. Shares nothing with Minco.
template <int D, int S>
RealMatrix dense_minimum_effort(const Problem<D, S>& problem) {
  const Conditions<D, S> conditions(problem);
  const int n = static_cast<int>(conditions.rows().cols());
  const int constraints = static_cast<int>(conditions.rows().rows());
  RealMatrix system = RealMatrix::Zero(n + constraints, n + constraints);
  RealMatrix right = RealMatrix::Zero(n + constraints, D);
  Eigen::Matrix<Real, Eigen::Dynamic, 1> scale(n);  // makes every piece's effort weigh alike
  for (int i = 0; i < problem.pieces(); ++i) {
    scale.segment(2 * S * i, 2 * S)
        .setConstant(std::pow(static_cast<Real>(problem.durations[i]), S - Real(0.5)));
    for (int a = S; a < 2 * S; ++a) {
      for (int b = S; b < 2 * S; ++b) {
        system(2 * S * i + a, 2 * S * i + b) =
            monomial_slope(a, S, 1.0) * monomial_slope(b, S, 1.0) / (a + b - 2 * S + 1);
      }
    }
  }
  const RealMatrix rows = conditions.rows() * scale.asDiagonal();
  for (int r = 0; r < constraints; ++r) {
    const Real size = rows.row(r).cwiseAbs().maxCoeff();
    system.row(n + r).head(n) = rows.row(r) / size;
    system.col(n + r).head(n) = rows.row(r).transpose() / size;
    right.row(n + r) = conditions.values().row(r) / size;
  }
  return scale.asDiagonal() * system.fullPivLu().solve(right).topRows(n);
}

}  // namespace mocha::test
