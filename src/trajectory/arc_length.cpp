#include "trajectory/arc_length.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace mocha {
namespace {

/// The speed along a part of one piece, by normalised time [m].
template <int D, int S>
struct Part {
  Eigen::Matrix<double, D, 2 * S - 1> velocity;  ///< column k: coefficient of u^k
  double from;
  double to;

  Part(const PiecewisePolynomial<D, S>& curve, int piece, double t0, double t1) {
    for (int k = 1; k < 2 * S; ++k) velocity.col(k - 1) = k * curve.piece(piece).col(k);
    const double start = curve.piece_start(piece);
    from = std::clamp((t0 - start) / curve.piece_duration(piece), 0.0, 1.0);
    to = std::clamp((t1 - start) / curve.piece_duration(piece), 0.0, 1.0);
  }

  double speed(double u) const {
    Eigen::Matrix<double, D, 1> sum = velocity.col(2 * S - 2);
    for (int k = 2 * S - 3; k >= 0; --k) sum = sum * u + velocity.col(k);
    return sum.norm();
  }

  /// Gauss-Legendre with five nodes between a and b.
  double quadrature(double a, double b) const {
    constexpr double kNodes[] = {0.538469310105683091036, 0.906179845938663992798};
    constexpr double kWeights[] = {0.478628670499366468041, 0.236926885056189087514};
    const double middle = 0.5 * (a + b);
    const double reach = 0.5 * (b - a);
    double sum = 128.0 / 225.0 * speed(middle);
    for (int n = 0; n < 2; ++n) {
      sum += kWeights[n] * (speed(middle - reach * kNodes[n]) + speed(middle + reach * kNodes[n]));
    }
    return reach * sum;
  }

  /// Halves until the error is within `error_rate` per unit of u, which suffices where the speed
  /// vanishes, or relatively within `tolerance`.
  double length(double a, double b, double whole, double error_rate, double tolerance) const {
    const double middle = 0.5 * (a + b);
    const double before = quadrature(a, middle);
    const double after = quadrature(middle, b);
    const double error = std::abs(before + after - whole);
    if (error <= std::max(error_rate * (b - a), tolerance * whole)) return before + after;
    return length(a, middle, before, error_rate, tolerance) +
           length(middle, b, after, error_rate, tolerance);
  }
};

}  // namespace

template <int D, int S>
double arc_length(const PiecewisePolynomial<D, S>& curve, double t0, double t1,
                  double relative_tolerance) {
  if (!(relative_tolerance >= 1e-12 && relative_tolerance <= 0.1)) {
    throw std::invalid_argument("arc_length: relative_tolerance = " +
                                std::to_string(relative_tolerance) + " is not in [1e-12, 0.1]");
  }
  if (!(t0 <= t1)) throw std::invalid_argument("arc_length: needs t0 <= t1");
  std::vector<Part<D, S>> parts;
  std::vector<double> estimates;
  double estimate = 0.0;
  for (int i = 0; i < curve.pieces(); ++i) {
    const Part<D, S> part(curve, i, t0, t1);
    if (!(part.from < part.to)) continue;
    parts.push_back(part);
    estimates.push_back(part.quadrature(part.from, part.to));
    estimate += estimates.back();
  }
  const double tolerance = 0.5 * relative_tolerance;
  double length = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double error_rate = tolerance * estimate / parts.size();
    length += parts[i].length(parts[i].from, parts[i].to, estimates[i], error_rate, tolerance);
  }
  return length;
}

template <int D, int S>
double arc_length(const PiecewisePolynomial<D, S>& curve, double relative_tolerance) {
  return arc_length(curve, 0.0, curve.duration(), relative_tolerance);
}

template double arc_length(const PiecewisePolynomial<2, 2>&, double);
template double arc_length(const PiecewisePolynomial<2, 3>&, double);
template double arc_length(const PiecewisePolynomial<2, 4>&, double);
template double arc_length(const PiecewisePolynomial<3, 2>&, double);
template double arc_length(const PiecewisePolynomial<3, 3>&, double);
template double arc_length(const PiecewisePolynomial<3, 4>&, double);
template double arc_length(const PiecewisePolynomial<2, 2>&, double, double, double);
template double arc_length(const PiecewisePolynomial<2, 3>&, double, double, double);
template double arc_length(const PiecewisePolynomial<2, 4>&, double, double, double);
template double arc_length(const PiecewisePolynomial<3, 2>&, double, double, double);
template double arc_length(const PiecewisePolynomial<3, 3>&, double, double, double);
template double arc_length(const PiecewisePolynomial<3, 4>&, double, double, double);

}  // namespace mocha
