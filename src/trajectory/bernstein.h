#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>

namespace mocha {

/// A polynomial of degree N over u in [0, 1] with values in R^D, in Bernstein form: column j is
/// control point j. Its values lie in the convex hull of the control points, whose first and last
/// are its values at the ends.
template <int D, int N>
using Bernstein = Eigen::Matrix<double, D, N + 1>;

constexpr double binomial(int n, int k) {
  double product = 1.0;
  for (int j = 0; j < k; ++j) product = product * (n - j) / (j + 1);
  return product;
}

/// Weights of the products of control points i and j of degrees M and N in control point i + j of
/// the product.
template <int M, int N>
constexpr std::array<std::array<double, N + 1>, M + 1> product_weights() {
  std::array<std::array<double, N + 1>, M + 1> weights{};
  for (int i = 0; i <= M; ++i) {
    for (int j = 0; j <= N; ++j) {
      weights[i][j] = binomial(M, i) * binomial(N, j) / binomial(M + N, i + j);
    }
  }
  return weights;
}

/// From coefficients of u^0 .. u^N (columns).
template <int D, int C>
Eigen::Matrix<double, D, C> to_bernstein(const Eigen::Matrix<double, D, C>& monomial) {
  Eigen::Matrix<double, D, C> control = Eigen::Matrix<double, D, C>::Zero();
  for (int j = 0; j < C; ++j) {
    for (int k = 0; k <= j; ++k) {
      control.col(j) += binomial(j, k) / binomial(C - 1, k) * monomial.col(k);
    }
  }
  return control;
}

/// The derivative by u.
template <int D, int C>
EIGEN_STRONG_INLINE Eigen::Matrix<double, D, C - 1> derivative(
    const Eigen::Matrix<double, D, C>& control) {
  return (C - 1) * (control.template rightCols<C - 1>() - control.template leftCols<C - 1>());
}

/// The parts before and after u, each again over [0, 1] (de Casteljau).
template <int D, int C>
std::pair<Eigen::Matrix<double, D, C>, Eigen::Matrix<double, D, C>> split(
    const Eigen::Matrix<double, D, C>& control, double u = 0.5) {
  std::pair<Eigen::Matrix<double, D, C>, Eigen::Matrix<double, D, C>> parts(control, control);
  for (int level = 1; level < C; ++level) {
    for (int j = 0; j < C - level; ++j) {
      parts.second.col(j) = (1.0 - u) * parts.second.col(j) + u * parts.second.col(j + 1);
    }
    parts.first.col(level) = parts.second.col(0);
  }
  return parts;
}

/// The polynomial of a bilinear product of the values of two others, such as their dot product.
template <int D, int A, int B, typename Product>
Eigen::Matrix<double, 1, A + B - 1> multiply(const Eigen::Matrix<double, D, A>& a,
                                             const Eigen::Matrix<double, D, B>& b,
                                             const Product& product) {
  static constexpr auto kWeights = product_weights<A - 1, B - 1>();
  Eigen::Matrix<double, 1, A + B - 1> control = Eigen::Matrix<double, 1, A + B - 1>::Zero();
  for (int i = 0; i < A; ++i) {
    for (int j = 0; j < B; ++j) control[i + j] += kWeights[i][j] * product(a.col(i), b.col(j));
  }
  return control;
}

template <int D, int C>
Eigen::Matrix<double, 1, 2 * C - 1> squared_norm(const Eigen::Matrix<double, D, C>& a) {
  return multiply(a, a, [](const auto& x, const auto& y) { return x.dot(y); });
}

/// The same polynomial in a form whose degree is higher by `Raise`.
template <int Raise, int C>
Eigen::Matrix<double, 1, C + Raise> elevate(const Eigen::Matrix<double, 1, C>& control) {
  const Eigen::Matrix<double, 1, Raise + 1> one = Eigen::Matrix<double, 1, Raise + 1>::Ones();
  return multiply(control, one, [](const auto& x, const auto& y) { return x[0] * y[0]; });
}

/// The polynomial divided by u, given that it vanishes at u = 0, in a form of the same degree.
template <int D, int C>
Eigen::Matrix<double, D, C> divided_at_start(const Eigen::Matrix<double, D, C>& control) {
  Eigen::Matrix<double, D, C> quotient = control;
  quotient.col(0).setZero();
  for (int j = 0; j + 1 < C; ++j) {
    quotient.col(j) += static_cast<double>(C - 1 - j) / (j + 1) * control.col(j + 1);
  }
  return quotient;
}

/// x of a times y of b minus the reverse.
template <int A, int B>
Eigen::Matrix<double, 1, A + B - 1> cross(const Eigen::Matrix<double, 2, A>& a,
                                          const Eigen::Matrix<double, 2, B>& b) {
  return multiply(a, b, [](const auto& x, const auto& y) { return x[0] * y[1] - x[1] * y[0]; });
}

/// The cross product, component by component.
template <int A, int B>
Eigen::Matrix<double, 3, A + B - 1> cross(const Eigen::Matrix<double, 3, A>& a,
                                          const Eigen::Matrix<double, 3, B>& b) {
  Eigen::Matrix<double, 3, A + B - 1> control;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    control.row(axis) = multiply(
        a, b, [=](const auto& x, const auto& y) { return x[next] * y[last] - x[last] * y[next]; });
  }
  return control;
}

/// The first u at which a polynomial exceeds zero, to `resolution`; none is a proof that it does
/// not, anywhere in [0, 1]. Where it comes so close to zero that halving down to `resolution`
/// cannot tell, it counts as exceeding.
template <int C>
std::optional<double> first_positive(const Eigen::Matrix<double, 1, C>& control,
                                     double resolution = 1e-7) {
  if ((control.array() <= 0.0).all()) return std::nullopt;
  if (!(control[0] <= 0.0) || resolution >= 1.0) return 0.0;
  const auto [before, after] = split(control);
  if (const auto u = first_positive(before, 2.0 * resolution)) return 0.5 * *u;
  if (const auto u = first_positive(after, 2.0 * resolution)) return 0.5 + 0.5 * *u;
  return std::nullopt;
}

}  // namespace mocha
