#include "trajectory/piecewise_polynomial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mocha {
namespace {

// Knots are told in hundredths of a millimetre: of two that are nearer to each other in time, this
// would make jerks. A polynomial of a smooth curve goes on for so long as its neighbour does.
constexpr double kShortestPiece_s = 0.002;

/// [order][k]: the factor that u^k gets by deriving it so often.
template <int Coefficients>
constexpr auto falling_factorials() {
  std::array<std::array<double, Coefficients>, Coefficients> factors{};
  for (int order = 0; order < Coefficients; ++order) {
    for (int k = order; k < Coefficients; ++k) {
      factors[order][k] = 1.0;
      for (int j = 0; j < order; ++j) factors[order][k] *= k - j;
    }
  }
  return factors;
}

}  // namespace

template <int D, int S>
PiecewisePolynomial<D, S>::PiecewisePolynomial(std::vector<Piece> pieces,
                                               std::vector<double> durations_s)
    : pieces_(std::move(pieces)), durations_(std::move(durations_s)) {
  if (pieces_.empty() || pieces_.size() != durations_.size()) {
    throw std::invalid_argument("PiecewisePolynomial: needs one duration per piece, at least one");
  }
  double end = 0.0;
  for (const double tau : durations_) {
    if (!(tau > 0.0) || !std::isfinite(tau)) {
      throw std::invalid_argument("PiecewisePolynomial: a duration is not positive and finite");
    }
    knots_.push_back(end += tau);
  }
}

template <int D, int S>
auto PiecewisePolynomial<D, S>::locate(double t) const -> Location {
  const auto knot = std::upper_bound(knots_.begin(), knots_.end(), t);
  const int i = std::min<int>(static_cast<int>(knot - knots_.begin()), pieces() - 1);
  return {i, std::clamp((t - piece_start(i)) / durations_[i], 0.0, 1.0)};
}

template <int D, int S>
auto PiecewisePolynomial<D, S>::derivative(double t, int order) const -> Vector {
  return derivative(locate(t), order);
}

template <int D, int S>
auto PiecewisePolynomial<D, S>::derivative(const Location& at, int order) const -> Vector {
  static constexpr auto kFalling = falling_factorials<kCoefficients>();
  const Piece& c = pieces_[at.piece];
  Vector sum = Vector::Zero();
  for (int k = kCoefficients - 1; k >= order; --k) sum = sum * at.u + kFalling[order][k] * c.col(k);
  double scale = 1.0;
  for (int j = 0; j < order; ++j) scale *= durations_[at.piece];
  return sum / scale;
}

template <int D, int S>
auto PiecewisePolynomial<D, S>::state(double t) const -> State {
  const Location at = locate(t);
  State state;
  for (int order = 0; order < S; ++order) state.col(order) = derivative(at, order);
  return state;
}

template <int D, int S>
PiecewisePolynomial<D, S> PiecewisePolynomial<D, S>::slice(double t0, double t1) const {
  if (!(t0 >= 0.0 && t0 < t1 && t1 <= duration() * (1.0 + 1e-12))) {
    throw std::invalid_argument("PiecewisePolynomial::slice: needs 0 <= t0 < t1 <= duration");
  }
  t1 = std::min(t1, duration());
  int first = locate(t0).piece;
  int last = locate(t1).piece;
  if (first < last && piece_start(first + 1) - t0 < kShortestPiece_s) ++first;
  if (first < last && t1 - piece_start(last) < kShortestPiece_s) --last;
  std::vector<Piece> pieces;
  std::vector<double> durations;
  for (int i = first; i <= last; ++i) {
    const double tau = durations_[i];
    const double u0 = i == first ? (t0 - piece_start(i)) / tau : 0.0;
    const double u1 = i == last ? (t1 - piece_start(i)) / tau : 1.0;
    // Taylor shift to u0, then scale by (u1 - u0).
    Piece shifted = pieces_[i];
    for (int j = 0; j < kCoefficients; ++j) {
      for (int k = kCoefficients - 2; k >= j; --k) shifted.col(k) += u0 * shifted.col(k + 1);
    }
    double power = 1.0;
    for (int k = 1; k < kCoefficients; ++k) shifted.col(k) *= power *= u1 - u0;
    pieces.push_back(shifted);
    durations.push_back((u1 - u0) * tau);
  }
  return PiecewisePolynomial(std::move(pieces), std::move(durations));
}

template <int D, int S>
PiecewisePolynomial<D, S> PiecewisePolynomial<D, S>::stretched(double factor) const {
  std::vector<double> durations = durations_;
  for (double& tau : durations) tau *= factor;
  return PiecewisePolynomial(pieces_, std::move(durations));
}

template class PiecewisePolynomial<2, 2>;
template class PiecewisePolynomial<2, 3>;
template class PiecewisePolynomial<2, 4>;
template class PiecewisePolynomial<3, 2>;
template class PiecewisePolynomial<3, 3>;
template class PiecewisePolynomial<3, 4>;

}  // namespace mocha
