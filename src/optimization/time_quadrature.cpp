#include "optimization/time_quadrature.h"

#include <Eigen/LU>
#include <cmath>

namespace mocha {
namespace {

double falling_factorial(int n, int k) {
  double product = 1.0;
  for (int j = 0; j < k; ++j) product *= n - j;
  return product;
}

bool contains(Derivatives set, int order) { return (set >> order) & 1u; }

}  // namespace

template <int D, int S>
TimeQuadrature<D, S>::TimeQuadrature(int kappa, int pieces, std::size_t penalties)
    : kappa_(kappa),
      alpha_(Eigen::VectorXd::LinSpaced(kappa + 1, 0.0, 1.0)),
      omega_(Eigen::VectorXd::Ones(kappa + 1)),
      samples_(kappa + 1),
      rows_(kappa + 1) {
  resize(pieces);
  active_.reserve(penalties);
  omega_[0] = omega_[kappa] = 0.5;
  for (int order = 0; order < kOrders; ++order) {
    basis_[order].setZero(kappa + 1, 2 * S);
    for (int j = 0; j <= kappa; ++j) {
      for (int k = order; k < 2 * S; ++k) {
        basis_[order](j, k) = falling_factorial(k, order) * std::pow(alpha_[j], k - order);
      }
    }
    weighted_basis_[order] = omega_.asDiagonal() * basis_[order];
  }
  set_end_tables();
}

template <int D, int S>
void TimeQuadrature<D, S>::resize(int pieces) {
  integrals_.assign(pieces, 0.0);
  by_time_.assign(pieces, 0.0);
}

template <int D, int S>
void TimeQuadrature<D, S>::set_end_tables() {
  // Of any size: solvers for each fixed one take long to compile, and this is done once.
  Eigen::MatrixXd effort = Eigen::MatrixXd::Zero(2 * S, 2 * S);  // by coefficients
  for (int k = 0; k < S; ++k) {
    for (int j = 0; j < 2 * S; ++j) {
      ends_by_coefficients_(k, j) = j == k ? falling_factorial(k, k) : 0.0;
      ends_by_coefficients_(S + k, j) = j < k ? 0.0 : falling_factorial(j, k);
      if (j < S) continue;
      for (int l = S; l < 2 * S; ++l) {
        effort(j, l) = falling_factorial(j, S) * falling_factorial(l, S) / (j + l - 2 * S + 1);
      }
    }
  }
  const Eigen::MatrixXd coefficients_by_ends = Eigen::MatrixXd(ends_by_coefficients_).inverse();
  effort_by_ends_ = coefficients_by_ends.transpose() * effort * coefficients_by_ends;
  for (int order = 0; order < kOrders; ++order)
    basis_by_ends_[order] = basis_[order] * coefficients_by_ends;
}

/// Which penalties may be other than zero on the piece whose bounds are set, and what they want.
template <int D, int S>
Derivatives TimeQuadrature<D, S>::choose(const Penalties& penalties) {
  Derivatives wanted = kNone;
  active_.clear();
  for (std::size_t p = 0; p < penalties.size(); ++p) {
    const Derivatives needs = penalties[p]->wanted(samples_.bounds);
    if (needs != kNone) active_.push_back(p);
    wanted |= needs;
  }
  return wanted;
}

template <int D, int S>
void TimeQuadrature<D, S>::sample(const Piece& coefficients, Derivatives wanted) {
  const double inverse_tau = 1.0 / samples_.bounds.duration_s;
  double scale = 1.0;
  for (int order = 0; order < kOrders; ++order, scale *= inverse_tau) {
    if (!contains(wanted, order)) continue;
    const Piece scaled = scale * coefficients;
    samples_.derivative[order].noalias() = basis_[order].lazyProduct(scaled.transpose());
    rows_.by_derivative[order].setZero();
  }
  if (wanted & kTime) {
    samples_.time_s =
        (samples_.bounds.start_s + samples_.bounds.duration_s * alpha_.array()).matrix();
    rows_.by_time.setZero();
  }
}

/// The integral over the piece; zero only if every sample's penalty is.
template <int D, int S>
double TimeQuadrature<D, S>::penalise(const Penalties& penalties, std::vector<double>& shares) {
  double sum = 0.0;
  for (const std::size_t p : active_) {
    rows_.value.setZero();
    penalties[p]->add(samples_, rows_);
    const double share = samples_.bounds.duration_s / kappa_ * omega_.dot(rows_.value);
    shares[p] += share;
    sum += share;
  }
  return sum;
}

/// Adds the gradient by the coefficients; returns that by the piece's own duration through the
/// samples' velocities and higher derivatives, which shrink as it grows.
template <int D, int S>
double TimeQuadrature<D, S>::propagate(Derivatives wanted, Piece& by_coefficients) {
  const double inverse_tau = 1.0 / samples_.bounds.duration_s;
  double scale = samples_.bounds.duration_s / kappa_;
  double by_tau = 0.0;
  for (int order = 0; order < kOrders; ++order, scale *= inverse_tau) {
    if (!contains(wanted, order)) continue;
    const auto& by_samples = rows_.by_derivative[order];
    const Piece by_scaled = by_samples.transpose().lazyProduct(weighted_basis_[order]);
    by_coefficients += scale * by_scaled;
    if (order == 0) continue;
    const auto products = by_samples.cwiseProduct(samples_.derivative[order]);
    for (int axis = 0; axis < D; ++axis) by_tau -= order * products.col(axis).dot(omega_) / kappa_;
  }
  return by_tau;
}

template <int D, int S>
double TimeQuadrature<D, S>::add(const Minco<D, S>& curve, const Penalties& penalties,
                                 std::vector<Piece>& by_piece, Eigen::VectorXd& by_duration,
                                 std::vector<double>& shares) {
  double total = 0.0;
  double start_s = 0.0;
  for (int i = 0; i < curve.pieces(); ++i) {
    const double tau = curve.piece_duration(i);
    integrals_[i] = by_time_[i] = 0.0;
    set_bounds(curve.piece(i), start_s, tau, samples_.bounds);
    start_s += tau;
    const Derivatives wanted = choose(penalties);
    if (wanted == kNone) continue;
    sample(curve.piece(i), wanted);
    integrals_[i] = penalise(penalties, shares);
    if (integrals_[i] == 0.0) continue;
    total += integrals_[i];
    by_duration[i] += integrals_[i] / tau + propagate(wanted, by_piece[i]);
    if (!(wanted & kTime)) continue;
    const auto by_time = rows_.by_time.cwiseProduct(omega_);
    by_time_[i] = tau / kappa_ * by_time.sum();
    by_duration[i] += tau / kappa_ * by_time.dot(alpha_);
  }
  // Paper (26): a longer piece moves every later sample in absolute time.
  double by_later = 0.0;
  for (int i = curve.pieces() - 1; i >= 0; --i) {
    by_duration[i] += by_later;
    by_later += by_time_[i];
  }
  return total;
}

/// To what is there, of the piece that is sampled.
template <int D, int S>
void TimeQuadrature<D, S>::add_penalty_curvature(const Penalty<D>& penalty, Derivatives wanted,
                                                 const Ends& ends) {
  rows_.value.setZero();
  for (int order = 0; order < kOrders; ++order) {
    if (contains(wanted, order)) rows_.by_derivative[order].setZero();
  }
  penalty.add(samples_, rows_);
  const double rate = 1.0 / samples_.bounds.duration_s;
  for (int j = 0; j <= kappa_; ++j) {
    if (!(rows_.value[j] > 0.0)) continue;
    Ends by_ends = Ends::Zero();
    double by_tau = 0.0;
    double scale = 1.0;
    for (int order = 0; order < kOrders; ++order, scale *= rate) {
      if (!contains(wanted, order)) continue;
      const auto by_sample = rows_.by_derivative[order].row(j);
      by_ends += (scale * by_sample.transpose()).lazyProduct(basis_by_ends_[order].row(j));
      by_tau -= order * by_sample.dot(samples_.derivative[order].row(j));
    }
    for (int k = 1; k < S; ++k) {
      by_tau += k * (by_ends.col(k).dot(ends.col(k)) + by_ends.col(S + k).dot(ends.col(S + k)));
    }
    Gradient gradient;
    gradient.template head<2 * S * D>() =
        Eigen::Map<const Eigen::Matrix<double, 2 * S * D, 1>>(by_ends.data());
    gradient[2 * S * D] = rate * by_tau;
    const double weight = omega_[j] / (rate * kappa_) * 2.0 / (3.0 * rows_.value[j]);
    curvature_ += (weight * gradient).lazyProduct(gradient.transpose());
  }
}

/// Of the square root of the effort's quadratic form, whose scale is tau^(1/2 - S).
template <int D, int S>
void TimeQuadrature<D, S>::add_effort_curvature(double weight, const Ends& ends) {
  const double tau = samples_.bounds.duration_s;
  const double scale = 2.0 * weight * std::pow(tau, 1 - 2 * S);
  for (int axis = 0; axis < D; ++axis) {
    Eigen::Matrix<double, 2 * S, 1> by_tau;
    for (int k = 0; k < 2 * S; ++k) by_tau[k] = (0.5 - S + k % S) / tau * ends(axis, k);
    const Eigen::Matrix<double, 2 * S, 1> pull = scale * effort_by_ends_ * by_tau;
    for (int k = 0; k < 2 * S; ++k) {
      for (int l = 0; l < 2 * S; ++l)
        curvature_(D * k + axis, D * l + axis) += scale * effort_by_ends_(k, l);
      curvature_(D * k + axis, 2 * S * D) += pull[k];
      curvature_(2 * S * D, D * k + axis) += pull[k];
    }
    curvature_(2 * S * D, 2 * S * D) += by_tau.dot(pull);
  }
}

template <int D, int S>
auto TimeQuadrature<D, S>::curvature(const Minco<D, S>& curve, const Penalties& penalties,
                                     double effort_weight, int i, double start_s)
    -> const PieceCurvature& {
  const double tau = curve.piece_duration(i);
  set_bounds(curve.piece(i), start_s, tau, samples_.bounds);
  const Ends ends = curve.piece(i) * ends_by_coefficients_.transpose();
  curvature_.setZero();
  const Derivatives wanted = choose(penalties);
  if (wanted != kNone) sample(curve.piece(i), wanted);
  for (const std::size_t p : active_) add_penalty_curvature(*penalties[p], wanted, ends);
  add_effort_curvature(effort_weight, ends);
  // By derivatives in time, instead of in normalised time.
  double scale = tau;
  for (int k = 1; k < S; ++k, scale *= tau) {
    for (const int end : {0, S}) {
      curvature_.template middleRows<D>(D * (end + k)) *= scale;
      curvature_.template middleCols<D>(D * (end + k)) *= scale;
    }
  }
  return curvature_;
}

template class TimeQuadrature<2, 3>;
template class TimeQuadrature<3, 3>;

}  // namespace mocha
