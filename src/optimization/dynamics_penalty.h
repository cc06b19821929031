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

  double add(const TrajectorySample<D>& sample, SampleGradient<D>& gradient) const override {
    const Cubic speed = cubic(sample.velocity.squaredNorm() * inverse_v2_ - 1.0);
    const Cubic acceleration = cubic(sample.acceleration.squaredNorm() * inverse_a2_ - 1.0);
    gradient.by_velocity += (2.0 * weight_ * speed.slope * inverse_v2_) * sample.velocity;
    gradient.by_acceleration +=
        (2.0 * weight_ * acceleration.slope * inverse_a2_) * sample.acceleration;
    return weight_ * (speed.value + acceleration.value);
  }

 private:
  double weight_;
  double inverse_v2_;
  double inverse_a2_;
};

}  // namespace mocha
