#pragma once

#include "optimization/penalty.h"

namespace mocha {

/// (32): phi(|v|^2 / v_max^2 - 1) + phi(|a|^2 / a_max^2 - 1).
template <int D>
class DynamicsPenalty : public Penalty<D> {
 public:
  /// Limits in m/s and m/s^2, positive.
  DynamicsPenalty(double weight, double max_speed, double max_acceleration)
      : weight_(weight),
        inverse_v2_(1.0 / (max_speed * max_speed)),
        inverse_a2_(1.0 / (max_acceleration * max_acceleration)) {}

  const char* name() const override { return "dynamics"; }

  Derivatives wanted(const PieceBounds<D>& piece) const override {
    return (piece.max_speed2 * inverse_v2_ > 1.0 ? kVelocity : kNone) |
           (piece.max_acceleration2 * inverse_a2_ > 1.0 ? kAcceleration : kNone);
  }

  void add(const PieceSamples<D>& samples, PenaltyRows<D>& rows) const override {
    const Derivatives which = wanted(samples.bounds);
    if (which & kVelocity)
      add_excess(samples.velocity(), inverse_v2_, rows.value, rows.by_velocity());
    if (which & kAcceleration) {
      add_excess(samples.acceleration(), inverse_a2_, rows.value, rows.by_acceleration());
    }
  }

 private:
  using Rows = typename PieceSamples<D>::Rows;

  void add_excess(const Rows& entries, double inverse_limit2, Eigen::VectorXd& value,
                  Rows& gradient) const {
    for (int j = 0; j < entries.rows(); ++j) {
      const Cubic excess = cubic(entries.row(j).squaredNorm() * inverse_limit2 - 1.0);
      if (excess.value == 0.0) continue;
      value[j] += weight_ * excess.value;
      gradient.row(j) += (2.0 * weight_ * excess.slope * inverse_limit2) * entries.row(j);
    }
  }

  double weight_;
  double inverse_v2_;
  double inverse_a2_;
};

}  // namespace mocha
