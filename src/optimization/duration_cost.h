#pragma once

#include <cmath>

namespace mocha {

/// What the total duration T of a trajectory costs: w_t T, paper (34), or w_t |T - mu|^3 where it
/// should last as long as a given horizon mu, paper (40).
class DurationCost {
 public:
  /// Nothing.
  DurationCost() = default;
  /// `weight` w_t in 1/s.
  static DurationCost total(double weight) { return {weight, Kind::kTotal, 0.0}; }
  /// `weight` w_t in 1/s^3, `mu_s` in s.
  static DurationCost with_horizon(double weight, double mu_s) {
    return {weight, Kind::kWithHorizon, mu_s};
  }

  double value(double total_s) const {
    if (kind_ == Kind::kTotal) return weight_ * total_s;
    const double off_s = std::abs(total_s - mu_s_);
    return weight_ * off_s * off_s * off_s;
  }

  /// Its derivative by T, paper (41).
  double slope(double total_s) const {
    if (kind_ == Kind::kTotal) return weight_;
    const double late_s = total_s - mu_s_;
    return 3.0 * weight_ * late_s * std::abs(late_s);
  }

 private:
  enum class Kind { kTotal, kWithHorizon };
  DurationCost(double weight, Kind kind, double mu_s) : weight_(weight), kind_(kind), mu_s_(mu_s) {}

  double weight_ = 0.0;
  Kind kind_ = Kind::kTotal;
  double mu_s_ = 0.0;
};

}  // namespace mocha
