#pragma once

#include "optimization/penalty.h"

namespace mocha {

/// Yaw rate of a planar flat output against its limit: phi(((v x a)^2 - omega_max^2 |v|^4) /
/// (omega_max^2 (|v|^2 + e^2)^2)).
///
/// The yaw rate itself, (v x a) / |v|^2, is singular at standstill; here the denominator never
/// falls below e^4, with e well below the speeds at which turning matters. At rest with an
/// acceleration (where drives begin and end) the yaw rate has the limit (a x j) / (2 |a|^2), and
/// that is what counts.
class TurningPenalty : public Penalty<2> {
 public:
  /// `max_yaw_rate` [rad/s] and `soft_speed` e [m/s] are positive.
  TurningPenalty(double weight, double max_yaw_rate, double soft_speed)
      : weight_(weight), max_yaw_rate_(max_yaw_rate), soft_speed2_(soft_speed * soft_speed) {}

  const char* name() const override { return "turning"; }

  double add(const TrajectorySample<2>& sample, SampleGradient<2>& gradient) const override {
    const Eigen::Vector2d& v = sample.velocity;
    const Eigen::Vector2d& a = sample.acceleration;
    const double speed2 = v.squaredNorm();
    if (speed2 < kRestSpeed2) return add_at_rest(sample, gradient);
    const double soft2 = speed2 + soft_speed2_;
    const double cross = (v.x() * a.y() - v.y() * a.x()) / max_yaw_rate_;
    const double excess = (cross * cross - speed2 * speed2) / (soft2 * soft2);
    const Cubic penalty = cubic(excess);
    if (penalty.value == 0.0) return 0.0;
    const double by_cross = 2.0 * cross / (soft2 * soft2 * max_yaw_rate_);
    const double by_speed2 = -2.0 * (speed2 / (soft2 * soft2) + excess / soft2);
    const double scale = weight_ * penalty.slope;
    gradient.by_velocity +=
        scale * (by_cross * Eigen::Vector2d(a.y(), -a.x()) + 2.0 * by_speed2 * v);
    gradient.by_acceleration += scale * by_cross * Eigen::Vector2d(-v.y(), v.x());
    return weight_ * penalty.value;
  }

 private:
  static constexpr double kRestSpeed2 = 1e-12;  // [m^2/s^2]
  static constexpr double kRestAcceleration2 =
      1e-6;  // [m^2/s^4] below, there is no limit to speak of

  double add_at_rest(const TrajectorySample<2>& sample, SampleGradient<2>& gradient) const {
    const Eigen::Vector2d& a = sample.acceleration;
    const Eigen::Vector2d& j = sample.jerk;
    const double a2 = a.squaredNorm();
    if (a2 < kRestAcceleration2) return 0.0;
    const double ratio = (a.x() * j.y() - a.y() * j.x()) / (2.0 * a2 * max_yaw_rate_);
    const Cubic penalty = cubic(ratio * ratio - 1.0);
    const double by_ratio = weight_ * penalty.slope * 2.0 * ratio;
    const double by_cross = by_ratio / (2.0 * a2 * max_yaw_rate_);
    gradient.by_acceleration +=
        by_cross * Eigen::Vector2d(j.y(), -j.x()) - (2.0 * by_ratio * ratio / a2) * a;
    gradient.by_jerk += by_cross * Eigen::Vector2d(-a.y(), a.x());
    return weight_ * penalty.value;
  }

  double weight_;
  double max_yaw_rate_;
  double soft_speed2_;
};

}  // namespace mocha
