#include "trajectory/extrema.h"

#include <algorithm>
#include <cmath>

#include "trajectory/bernstein.h"

namespace mocha {
namespace {

constexpr double kTolerance = 1e-9;  // relative, of the result
constexpr double kFinest = 1e-12;    // of normalised time

/// The largest value of a polynomial over [0, 1], found by halving where the hull leaves room for
/// more than is known already.
template <int C>
class LargestValue {
 public:
  void look(const Eigen::Matrix<double, 1, C>& control, double begin, double width) {
    keep(control[0], begin);
    keep(control[C - 1], begin + width);
    const double bound = control.maxCoeff();
    if (bound <= value_ * (1.0 + kTolerance)) {
      bound_ = std::max(bound_, bound);
      return;
    }
    if (width < kFinest) {
      keep(bound, begin);
      return;
    }
    const auto [before, after] = split(control);
    look(before, begin, 0.5 * width);
    look(after, begin + 0.5 * width, 0.5 * width);
  }

  double value() const { return std::max(bound_, value_); }
  double at() const { return at_; }

 private:
  void keep(double value, double u) {
    if (value <= value_) return;
    value_ = value;
    at_ = u;
  }

  double value_ = 0.0;  // of a squared norm: nothing is below
  double bound_ = 0.0;
  double at_ = 0.0;
};

template <int D, int S, int Order>
Extremum largest_norm(const PiecewisePolynomial<D, S>& curve) {
  Extremum largest{0.0, 0.0};
  for (int i = 0; i < curve.pieces(); ++i) {
    const double tau = curve.piece_duration(i);
    const auto course = derivative(to_bernstein(curve.piece(i)));
    const auto squared = [&] {
      if constexpr (Order == 1) return squared_norm(course);
      if constexpr (Order == 2) return squared_norm(derivative(course));
    }();
    LargestValue<decltype(squared)::ColsAtCompileTime> search;
    search.look(squared, 0.0, 1.0);
    const double value = std::sqrt(search.value()) / std::pow(tau, Order);
    if (value > largest.value) largest = {value, curve.piece_start(i) + search.at() * tau};
  }
  return largest;
}

}  // namespace

template <int D, int S>
Extremum max_speed(const PiecewisePolynomial<D, S>& curve) {
  return largest_norm<D, S, 1>(curve);
}

template <int D, int S>
Extremum max_acceleration(const PiecewisePolynomial<D, S>& curve) {
  return largest_norm<D, S, 2>(curve);
}

template <int D, int S>
double stretch_within(const PiecewisePolynomial<D, S>& curve, double max_speed_mps,
                      double max_acceleration_mps2) {
  return std::max({1.0, max_speed(curve).value / max_speed_mps,
                   std::sqrt(max_acceleration(curve).value / max_acceleration_mps2)});
}

#define MOCHA_INSTANTIATE(D, S)                                         \
  template Extremum max_speed(const PiecewisePolynomial<D, S>&);        \
  template Extremum max_acceleration(const PiecewisePolynomial<D, S>&); \
  template double stretch_within(const PiecewisePolynomial<D, S>&, double, double);
MOCHA_INSTANTIATE(2, 2)
MOCHA_INSTANTIATE(2, 3)
MOCHA_INSTANTIATE(2, 4)
MOCHA_INSTANTIATE(3, 2)
MOCHA_INSTANTIATE(3, 3)
MOCHA_INSTANTIATE(3, 4)
#undef MOCHA_INSTANTIATE

}  // namespace mocha
