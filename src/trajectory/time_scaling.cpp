#include "trajectory/time_scaling.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "trajectory/extrema.h"

namespace mocha {
namespace {

constexpr double kScalingTolerance = 1e-9;  // relative
constexpr double kStandstill = 1e-6;        // [m/s]

void require_of_scaling(bool condition, const char* name, double value, const char* range) {
  if (condition) return;
  throw std::invalid_argument(std::string("smallest_stretch: ") + name + " = " +
                              std::to_string(value) + " is not " + range);
}

}  // namespace

template <int D, int S>
std::optional<double> smallest_stretch(const PiecewisePolynomial<D, S>& curve,
                                       const StretchLimits& limits) {
  require_of_scaling(limits.speed > 0.0, "speed", limits.speed, "above 0 m/s");
  require_of_scaling(limits.acceleration > 0.0, "acceleration", limits.acceleration,
                     "above 0 m/s^2");
  require_of_scaling(limits.largest_factor >= 1.0, "largest_factor", limits.largest_factor,
                     "at least 1");
  // Speed falls with the factor, acceleration with its square.
  const double factor = std::max(max_speed(curve).value / limits.speed,
                                 std::sqrt(max_acceleration(curve).value / limits.acceleration));
  if (factor <= 1.0 + kScalingTolerance) return 1.0;
  const bool from_rest = curve.derivative(0.0, 1).norm() <= kStandstill;
  const bool to_rest = curve.derivative(curve.duration(), 1).norm() <= kStandstill;
  if (!from_rest || !to_rest || factor > limits.largest_factor) return std::nullopt;
  return factor;
}

template std::optional<double> smallest_stretch(const PiecewisePolynomial<2, 2>&,
                                                const StretchLimits&);
template std::optional<double> smallest_stretch(const PiecewisePolynomial<2, 3>&,
                                                const StretchLimits&);
template std::optional<double> smallest_stretch(const PiecewisePolynomial<2, 4>&,
                                                const StretchLimits&);
template std::optional<double> smallest_stretch(const PiecewisePolynomial<3, 2>&,
                                                const StretchLimits&);
template std::optional<double> smallest_stretch(const PiecewisePolynomial<3, 3>&,
                                                const StretchLimits&);
template std::optional<double> smallest_stretch(const PiecewisePolynomial<3, 4>&,
                                                const StretchLimits&);

}  // namespace mocha
