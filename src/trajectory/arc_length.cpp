#include "trajectory/arc_length.h"

#include <cmath>

namespace mocha {
namespace {

constexpr double kTolerance = 1e-10;  // relative, of each half
constexpr int kDeepest = 30;

/// Integral of |dp/du| over [u0, u1] of a piece, by Gauss-Legendre with five points.
template <int D, int S>
double gauss(const typename PiecewisePolynomial<D, S>::Piece& piece, double u0, double u1) {
  constexpr double kNodes[] = {0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr double kWeights[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = 0.5 * (u0 + u1);
  const double half = 0.5 * (u1 - u0);
  const auto speed = [&](double u) {
    Eigen::Matrix<double, D, 1> course = Eigen::Matrix<double, D, 1>::Zero();
    for (int k = 2 * S - 1; k >= 1; --k) course = course * u + k * piece.col(k);
    return course.norm();
  };
  double sum = kWeights[0] * speed(middle);
  for (int i = 1; i < 3; ++i) {
    sum += kWeights[i] * (speed(middle - half * kNodes[i]) + speed(middle + half * kNodes[i]));
  }
  return half * sum;
}

/// Halves until both halves add up to the whole; a cusp of the curve is only approached.
template <int D, int S>
double adaptive(const typename PiecewisePolynomial<D, S>::Piece& piece, double u0, double u1,
                double whole, int depth) {
  const double middle = 0.5 * (u0 + u1);
  const double left = gauss<D, S>(piece, u0, middle);
  const double right = gauss<D, S>(piece, middle, u1);
  if (depth == kDeepest || std::abs(left + right - whole) <= kTolerance * whole) {
    return left + right;
  }
  return adaptive<D, S>(piece, u0, middle, left, depth + 1) +
         adaptive<D, S>(piece, middle, u1, right, depth + 1);
}

}  // namespace

template <int D, int S>
double arc_length(const PiecewisePolynomial<D, S>& curve) {
  double sum = 0.0;
  for (int i = 0; i < curve.pieces(); ++i) {
    const auto& piece = curve.piece(i);
    sum += adaptive<D, S>(piece, 0.0, 1.0, gauss<D, S>(piece, 0.0, 1.0), 0);
  }
  return sum;
}

template double arc_length(const PiecewisePolynomial<2, 2>&);
template double arc_length(const PiecewisePolynomial<2, 3>&);
template double arc_length(const PiecewisePolynomial<2, 4>&);
template double arc_length(const PiecewisePolynomial<3, 2>&);
template double arc_length(const PiecewisePolynomial<3, 3>&);
template double arc_length(const PiecewisePolynomial<3, 4>&);

}  // namespace mocha
