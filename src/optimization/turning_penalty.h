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

  Derivatives wanted(const PieceBounds<2>& piece) const override {
    // |v x a| <= |v| |a|
    const double turns_slower_than2 = max_yaw_rate_ * max_yaw_rate_ * piece.min_speed2;
    if (piece.max_acceleration2 <= turns_slower_than2) return kNone;
    return kVelocity | kAcceleration | (piece.min_speed2 < kRestSpeed2 ? kJerk : kNone);
  }

  void add(const PieceSamples<2>& samples, PenaltyRows<2>& rows) const override {
    for (int j = 0; j < samples.size(); ++j) {
      if (samples.velocity().row(j).squaredNorm() < kRestSpeed2) {
        add_at_rest(samples, j, rows);
      } else {
        add_moving(samples, j, rows);
      }
    }
  }

 private:
  using Vector = Eigen::Vector2d;
  static constexpr double kRestSpeed2 = 1e-12;  // [m^2/s^2]
  static constexpr double kRestAcceleration2 =
      1e-6;  // [m^2/s^4] below, there is no limit to speak of

  void add_moving(const PieceSamples<2>& samples, int j, PenaltyRows<2>& rows) const {
    const Vector v = samples.velocity().row(j);
    const Vector a = samples.acceleration().row(j);
    const double speed2 = v.squaredNorm();
    const double soft2 = speed2 + soft_speed2_;
    const double cross = (v.x() * a.y() - v.y() * a.x()) / max_yaw_rate_;
    const double excess = (cross * cross - speed2 * speed2) / (soft2 * soft2);
    const Cubic penalty = cubic(excess);
    if (penalty.value == 0.0) return;
    const double by_cross = 2.0 * cross / (soft2 * soft2 * max_yaw_rate_);
    const double by_speed2 = -2.0 * (speed2 / (soft2 * soft2) + excess / soft2);
    const double scale = weight_ * penalty.slope;
    rows.value[j] += weight_ * penalty.value;
    rows.by_velocity().row(j) += scale * (by_cross * Vector(a.y(), -a.x()) + 2.0 * by_speed2 * v);
    rows.by_acceleration().row(j) += scale * by_cross * Vector(-v.y(), v.x());
  }

  void add_at_rest(const PieceSamples<2>& samples, int index, PenaltyRows<2>& rows) const {
    const Vector a = samples.acceleration().row(index);
    const Vector j = samples.jerk().row(index);
    const double a2 = a.squaredNorm();
    if (a2 < kRestAcceleration2) return;
    const double ratio = (a.x() * j.y() - a.y() * j.x()) / (2.0 * a2 * max_yaw_rate_);
    const Cubic penalty = cubic(ratio * ratio - 1.0);
    const double by_ratio = weight_ * penalty.slope * 2.0 * ratio;
    const double by_cross = by_ratio / (2.0 * a2 * max_yaw_rate_);
    rows.value[index] += weight_ * penalty.value;
    rows.by_acceleration().row(index) +=
        by_cross * Vector(j.y(), -j.x()) - (2.0 * by_ratio * ratio / a2) * a;
    rows.by_jerk().row(index) += by_cross * Vector(-a.y(), a.x());
  }

  double weight_;
  double max_yaw_rate_;
  double soft_speed2_;
};

}  // namespace mocha
