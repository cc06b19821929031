#include "trajectory/minco.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cassert>
#include <cmath>

namespace mocha {
namespace {

double falling_factorial(int n, int k) {
  double product = 1.0;
  for (int j = 0; j < k; ++j) product *= n - j;
  return product;
}

/// Matrices that depend on S alone, for one piece in normalised time.
template <int S>
struct Constants {
  using Matrix = Eigen::Matrix<double, 2 * S, 2 * S>;
  Matrix hermite;      ///< end derivatives (start 0..S-1, end 0..S-1) -> coefficients
  Matrix effort;       ///< coefficients -> effort (27)
  Matrix ends_effort;  ///< end derivatives -> effort

  Constants() {
    Matrix evaluate = Matrix::Zero();
    effort.setZero();
    for (int k = 0; k < S; ++k) {
      evaluate(k, k) = falling_factorial(k, k);
      for (int j = k; j < 2 * S; ++j) evaluate(S + k, j) = falling_factorial(j, k);
    }
    for (int a = S; a < 2 * S; ++a) {
      for (int b = S; b < 2 * S; ++b) {
        effort(a, b) = falling_factorial(a, S) * falling_factorial(b, S) / (a + b - 2 * S + 1);
      }
    }
    hermite = evaluate.inverse();
    ends_effort = hermite.transpose() * effort * hermite;
  }
};

template <int S>
const Constants<S>& constants() {
  static const Constants<S> instance;
  return instance;
}

/// tau^0 .. tau^(S-1), repeated for both ends: scales derivatives by time to normalised ones.
template <int S>
Eigen::Matrix<double, 2 * S, 1> end_scales(double tau) {
  Eigen::Matrix<double, 2 * S, 1> scales;
  double power = 1.0;
  for (int k = 0; k < S; ++k, power *= tau) scales[k] = scales[S + k] = power;
  return scales;
}

}  // namespace

template <int D, int S>
void Minco<D, S>::resize(int pieces) {
  assert(pieces >= 1);
  states_.resize(pieces + 1);
  pieces_.resize(pieces);
  tau_.resize(pieces);
  energy_.resize(pieces);
  by_ends_.resize(pieces);
  diagonal_.resize(pieces - 1);
  below_.resize(pieces - 1);
  work_.resize(pieces - 1);
}

template <int D, int S>
auto Minco<D, S>::ends(int i) const -> Ends {
  Ends ends;
  ends.template topRows<S>() = states_[i].transpose();
  ends.template bottomRows<S>() = states_[i + 1].transpose();
  return ends;
}

template <int D, int S>
void Minco<D, S>::solve(const State& start, const State& end, const Knots& knots,
                        const Eigen::VectorXd& durations_s) {
  const int m = pieces();
  assert(durations_s.size() == m && knots.cols() == m - 1);
  const auto& constant = constants<S>();
  states_.front() = start;
  states_.back() = end;
  for (int k = 1; k < m; ++k) {
    states_[k].setZero();
    states_[k].col(0) = knots.col(k - 1);
  }
  for (int i = 0; i < m; ++i) {
    tau_[i] = durations_s[i];
    const auto scales = end_scales<S>(tau_[i]);
    energy_[i] = std::pow(tau_[i], 1 - 2 * S) *
                 (scales.asDiagonal() * constant.ends_effort * scales.asDiagonal());
  }
  factor();
  // With the unknown derivatives still zero, the effort's gradient is minus the right-hand side.
  for (int k = 0; k + 1 < m; ++k) {
    work_[k] = -(energy_[k].template bottomRows<kFree>() * ends(k) +
                 energy_[k + 1].template middleRows<kFree>(1) * ends(k + 1));
  }
  substitute(work_);
  for (int k = 1; k < m; ++k) {
    states_[k].template rightCols<kFree>() = work_[k - 1].transpose();
  }
  for (int i = 0; i < m; ++i) {
    pieces_[i].noalias() =
        (constant.hermite * (end_scales<S>(tau_[i]).asDiagonal() * ends(i))).transpose();
  }
}

template <int D, int S>
void Minco<D, S>::factor() {
  for (int k = 0; k + 1 < pieces(); ++k) {
    Block block = energy_[k].template bottomRightCorner<kFree, kFree>() +
                  energy_[k + 1].template block<kFree, kFree>(1, 1);
    if (k > 0) {
      below_[k] = energy_[k].template block<kFree, kFree>(S + 1, 1) * diagonal_[k - 1].transpose();
      block.noalias() -= below_[k] * below_[k].transpose();
    }
    const Eigen::LLT<Block> cholesky(block);
    diagonal_[k].setIdentity();
    cholesky.matrixL().solveInPlace(diagonal_[k]);
  }
}

template <int D, int S>
void Minco<D, S>::substitute(std::vector<Rows>& rhs) const {
  const int n = static_cast<int>(rhs.size());
  for (int k = 0; k < n; ++k) {
    if (k > 0) rhs[k].noalias() -= below_[k] * rhs[k - 1];
    rhs[k] = (diagonal_[k] * rhs[k]).eval();
  }
  for (int k = n - 1; k >= 0; --k) {
    if (k + 1 < n) rhs[k].noalias() -= below_[k + 1].transpose() * rhs[k + 1];
    rhs[k] = (diagonal_[k].transpose() * rhs[k]).eval();
  }
}

template <int D, int S>
auto Minco<D, S>::curve() const -> Curve {
  return Curve(pieces_, tau_);
}

template <int D, int S>
double Minco<D, S>::effort() const {
  double sum = 0.0;
  for (int i = 0; i < pieces(); ++i) {
    sum += std::pow(tau_[i], 1 - 2 * S) *
           (pieces_[i] * constants<S>().effort).cwiseProduct(pieces_[i]).sum();
  }
  return sum;
}

template <int D, int S>
void Minco<D, S>::add_effort_gradient(double weight, std::vector<Piece>& by_piece,
                                      Eigen::VectorXd& by_duration) const {
  for (int i = 0; i < pieces(); ++i) {
    const Piece half = weight * std::pow(tau_[i], 1 - 2 * S) * pieces_[i] * constants<S>().effort;
    by_piece[i] += 2.0 * half;
    by_duration[i] += (1 - 2 * S) / tau_[i] * half.cwiseProduct(pieces_[i]).sum();
  }
}

template <int D, int S>
void Minco<D, S>::propagate(const std::vector<Piece>& by_piece, Eigen::VectorXd& by_duration,
                            Knots& by_knot) {
  const int m = pieces();
  const auto& constant = constants<S>();
  for (int i = 0; i < m; ++i) {
    const auto scales = end_scales<S>(tau_[i]);
    const Ends by_scaled = constant.hermite.transpose() * by_piece[i].transpose();
    by_ends_[i] = scales.asDiagonal() * by_scaled;
    const Ends end_data = ends(i);
    for (int a = 0; a < 2 * S; ++a) {
      by_duration[i] += (a % S) / tau_[i] * by_ends_[i].row(a).dot(end_data.row(a));
    }
  }
  for (int k = 0; k + 1 < m; ++k) {
    work_[k] =
        by_ends_[k].template bottomRows<kFree>() + by_ends_[k + 1].template middleRows<kFree>(1);
  }
  substitute(
      work_);  // the adjoint: how J feels the optimality conditions of the unknown derivatives
  for (int k = 0; k + 1 < m; ++k) {
    by_knot.col(k) = (by_ends_[k].row(S) + by_ends_[k + 1].row(0)).transpose();
  }
  for (int i = 0; i < m; ++i) {
    Ends adjoint = Ends::Zero();
    if (i > 0) adjoint.template middleRows<kFree>(1) = work_[i - 1];
    if (i + 1 < m) adjoint.template bottomRows<kFree>() = work_[i];
    const Ends force = energy_[i] * adjoint;
    if (i > 0) by_knot.col(i - 1) -= force.row(0).transpose();
    if (i + 1 < m) by_knot.col(i) -= force.row(S).transpose();
    const Ends end_data = ends(i);
    const Ends response = energy_[i] * end_data;
    for (int a = 0; a < 2 * S; ++a) {
      // d(energy)_ab/d(tau) = (d_a + d_b + 1 - 2S) / tau * energy_ab, with d the derivative order
      // of the entry.
      by_duration[i] -= ((a % S) + 0.5 * (1 - 2 * S)) / tau_[i] *
                        (adjoint.row(a).dot(response.row(a)) + force.row(a).dot(end_data.row(a)));
    }
  }
}

template class Minco<2, 2>;
template class Minco<2, 3>;
template class Minco<2, 4>;
template class Minco<3, 2>;
template class Minco<3, 3>;
template class Minco<3, 4>;

}  // namespace mocha
