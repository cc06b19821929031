#pragma once

#include <cmath>
#include <utility>

namespace mocha {

/// Duration [s] of an unconstrained variable, always positive, paper (12).
inline double duration_of(double eta) {
  return eta > 0.0 ? (0.5 * eta + 1.0) * eta + 1.0 : 1.0 / ((0.5 * eta - 1.0) * eta + 1.0);
}

/// Its derivative, paper (20), where the duration itself is known already.
inline double duration_slope(double eta, double duration_s) {
  return eta > 0.0 ? eta + 1.0 : (1.0 - eta) * duration_s * duration_s;
}
inline double duration_slope(double eta) { return duration_slope(eta, duration_of(eta)); }

/// Inverse of duration_of() for a positive duration [s].
inline double eta_of(double duration_s) {
  return duration_s > 1.0 ? std::sqrt(2.0 * duration_s - 1.0) - 1.0
                          : 1.0 - std::sqrt(2.0 / duration_s - 1.0);
}

/// A scalar kept inside (low, high) by a scaled logistic function, paper (13)(19), of an
/// unconstrained variable.
///
/// `scale` stretches the unconstrained axis: the paper's map has scale 1; choosing it so that one
/// unit of the variable moves the knot about a metre makes all variables of the optimiser alike.
struct LogisticMap {
  double low;
  double high;
  double scale;

  double value(double xi) const { return low + (high - low) * sigma(xi); }
  double slope(double xi) const { return value_and_slope(xi).second; }
  std::pair<double, double> value_and_slope(double xi) const {
    const double s = sigma(xi);
    return {low + (high - low) * s, (high - low) * scale * s * (1.0 - s)};
  }
  /// Requires low < value < high.
  double inverse(double value) const { return std::log((value - low) / (high - value)) / scale; }

 private:
  double sigma(double xi) const { return 1.0 / (1.0 + std::exp(-scale * xi)); }
};

}  // namespace mocha
