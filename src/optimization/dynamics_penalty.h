#pragma once

#include "optimization/penalty.h"

namespace mocha {

/// Paper (32): phi(|v|^2 / v_max^2 - 1) + phi(|a|^2 / a_max^2 - 1).
template <int D>
class DynamicsPenalty : public Penalty<D> {
 public:
  /// Limits in m/s and m/s^2, positive.
  DynamicsPenalty(double weight, double max_speed, double max_acceleration)
      : DynamicsPenalty(weight, max_speed, weight, max_acceleration) {}

  /// With a weight for each.
  DynamicsPenalty(double speed_weight, double max_speed, double acceleration_weight,
                  double max_acceleration)
      : speed_weight_(speed_weight),
        acceleration_weight_(acceleration_weight),
        inverse_v2_(1.0 / (max_speed * max_speed)),
        inverse_a2_(1.0 / (max_acceleration * max_acceleration)) {}

  const char* name() const override { return "dynamics"; }

  Derivatives wanted(const PieceBounds<D>& piece) const override {
    return (piece.max_speed2 * inverse_v2_ > 1.0 ? kVelocity : kNone) |
           (piece.max_acceleration2 * inverse_a2_ > 1.0 ? kAcceleration : kNone);
  }

  void add(const PieceSamples<D>& samples, PenaltyRows<D>& rows) const override {
    const Derivatives which = wanted(samples.bounds);
    if (which & kVelocity) {
      add_excess(samples.velocity(), speed_weight_, inverse_v2_, rows.value, rows.by_velocity());
    }
    if (which & kAcceleration) {
      add_excess(samples.acceleration(), acceleration_weight_, inverse_a2_, rows.value,
                 rows.by_acceleration());
    }
  }

 private:
  using Rows = typename PieceSamples<D>::Rows;

  static void add_excess(const Rows& entries, double weight, double inverse_limit2,
                         Eigen::VectorXd& value, Rows& gradient) {
    for (int j = 0; j < entries.rows(); ++j) {
      const Cubic excess = cubic(entries.row(j).squaredNorm() * inverse_limit2 - 1.0);
      if (excess.value == 0.0) continue;
      value[j] += weight * excess.value;
      gradient.row(j) += (2.0 * weight * excess.slope * inverse_limit2) * entries.row(j);
    }
  }

  double speed_weight_;
  double acceleration_weight_;
  double inverse_v2_;
  double inverse_a2_;
};

}  // namespace mocha
