#pragma once

#include <cmath>

#include "optimization/penalty.h"
#include "world/robot_model.h"

namespace mocha {

/// Speed of the faster wheel of a differential drive, u = |v| + b / 2 |v x a| / |v|^2 with b the
/// track, against its limit w: phi((u^2 - w^2) |v|^4 / (w^2 (|v|^2 + e^2)^2)), which has no
/// quotient that is singular at standstill.
///
/// At rest the wheels turn as the yaw rate asks, and a robot whose wheels can turn it in place at
/// its highest yaw rate needs no more there than the turning penalty.
class WheelPenalty : public Penalty<2> {
 public:
  /// `limits.max_wheel_speed` is positive and finite, `soft_speed` e [m/s] positive.
  WheelPenalty(double weight, const MotionLimits& limits, double soft_speed)
      : weight_(weight),
        half_track_m_(0.5 * limits.track_m),
        wheel_speed2_(limits.max_wheel_speed * limits.max_wheel_speed),
        soft_speed2_(soft_speed * soft_speed) {}

  const char* name() const override { return "wheels"; }

  Derivatives wanted(const PieceBounds<2>& piece) const override {
    // |v x a| / |v|^2 <= |a| / |v|
    const double swing = half_track_m_ * std::sqrt(piece.max_acceleration2 / piece.min_speed2);
    const double fastest = std::sqrt(piece.max_speed2) + swing;
    return fastest * fastest <= wheel_speed2_ ? kNone : kVelocity | kAcceleration;
  }

  void add(const PieceSamples<2>& samples, PenaltyRows<2>& rows) const override {
    for (int j = 0; j < samples.size(); ++j) {
      const Eigen::Vector2d v = samples.velocity().row(j);
      const Eigen::Vector2d a = samples.acceleration().row(j);
      const double speed2 = v.squaredNorm();
      const double cross = v.x() * a.y() - v.y() * a.x();
      const double side = cross < 0.0 ? -1.0 : 1.0;
      const double speed = std::sqrt(speed2);
      const double rim = speed2 * speed + half_track_m_ * side * cross;  // u |v|^2
      const double soft2 = speed2 + soft_speed2_;
      const double scale = 1.0 / (wheel_speed2_ * soft2 * soft2);
      const double excess = (rim * rim - wheel_speed2_ * speed2 * speed2) * scale;
      const Cubic penalty = cubic(excess);
      if (penalty.value == 0.0) continue;
      const double by_rim = 2.0 * rim * scale;
      const double by_speed2 =
          1.5 * speed * by_rim - 2.0 * wheel_speed2_ * speed2 * scale - 2.0 * excess / soft2;
      const double by_cross = by_rim * half_track_m_ * side;
      const double slope = weight_ * penalty.slope;
      rows.value[j] += weight_ * penalty.value;
      rows.by_velocity().row(j) +=
          slope * (by_cross * Eigen::Vector2d(a.y(), -a.x()) + 2.0 * by_speed2 * v);
      rows.by_acceleration().row(j) += slope * by_cross * Eigen::Vector2d(-v.y(), v.x());
    }
  }

 private:
  double weight_;
  double half_track_m_;
  double wheel_speed2_;
  double soft_speed2_;
};

}  // namespace mocha
