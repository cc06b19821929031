#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimization/penalty.h"
#include "world/obstacle_field.h"

namespace mocha {

/// Paper (30): phi(1 - d_r |d_r| / d_s^2), summed over the obstacles r that the field tells apart,
/// at the centre of each disc or ball that covers the robot.
///
/// d_r is signed, so that a sample inside an obstacle is pushed out as well. The heading h is the
/// direction of travel, v / sqrt(|v|^2 + e^2): near standstill the discs slide together to the
/// base; the certificate judges the true footprint. In the plane, a disc is centred ahead and to
/// the left of the base, at p + ahead h + left J h; in space along the heading.
template <int D>
class ObstaclePenalty : public Penalty<D> {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// A covering disc or ball, and the distance d_s to keep from its centre.
  struct Cover {
    double ahead_m;
    double safety_distance_m;
    double left_m = 0.0;  ///< none in space
  };

  /// `field` must outlive the penalty. `soft_speed` e [m/s] is positive.
  ObstaclePenalty(double weight, const ObstacleField<D>& field, std::vector<Cover> cover,
                  double soft_speed)
      : weight_(weight),
        field_(field),
        cover_(std::move(cover)),
        soft_speed2_(soft_speed * soft_speed) {
    for (const Cover& each : cover_) {
      reach_m_ = std::max(reach_m_, std::hypot(each.ahead_m, each.left_m) + each.safety_distance_m);
      if (each.ahead_m != 0.0 || each.left_m != 0.0) wanted_ = kPosition | kVelocity;
    }
  }

  const char* name() const override { return "obstacle"; }

  Derivatives wanted(const PieceBounds<D>& piece) const override {
    return field_.clear(piece.box, reach_m_) ? kNone : wanted_;
  }

  void add(const PieceSamples<D>& samples, PenaltyRows<D>& rows) const override {
    const double step_m = std::sqrt(samples.bounds.max_speed2) * samples.bounds.duration_s /
                          std::max(1, samples.size() - 1);
    bool is_near = false;  // the sample before: then this one most likely has no room either
    for (int j = 0; j < samples.size();) {
      const double room_m = is_near ? 0.0 : field_.room(samples.position().row(j), reach_m_);
      if (room_m > 0.0) {
        const bool to_the_end = !(room_m < step_m * samples.size());
        j += to_the_end ? samples.size() : 1 + static_cast<int>(room_m / step_m);
        continue;
      }
      const double before = rows.value[j];
      if (wanted_ == kPosition) {
        add_at_base(samples, j, rows);
      } else {
        add_off_base(samples, j, rows);
      }
      is_near = rows.value[j] != before;
      ++j;
    }
  }

 private:
  /// J h of a vector in the plane.
  static Vector left_of(const Vector& h) {
    static_assert(D == 2);
    return {-h.y(), h.x()};
  }

  /// The gradient by the place of the disc's centre.
  Vector add_at(const Vector& centre, double safety_distance_m, double& value) const {
    const double inverse_ds2 = 1.0 / (safety_distance_m * safety_distance_m);
    Vector by_centre = Vector::Zero();
    field_.visit_near(centre, safety_distance_m, [&](const auto& obstacle) {
      const double d = obstacle.distance_m;
      const Cubic penalty = cubic(1.0 - d * std::abs(d) * inverse_ds2);
      value += weight_ * penalty.value;
      by_centre -= (2.0 * weight_ * penalty.slope * std::abs(d) * inverse_ds2) * obstacle.gradient;
    });
    return by_centre;
  }

  /// Where all discs are at the base, which need no heading.
  void add_at_base(const PieceSamples<D>& samples, int j, PenaltyRows<D>& rows) const {
    const Vector base = samples.position().row(j);
    for (const Cover& cover : cover_)
      rows.by_position().row(j) += add_at(base, cover.safety_distance_m, rows.value[j]);
  }

  void add_off_base(const PieceSamples<D>& samples, int j, PenaltyRows<D>& rows) const {
    const Vector base = samples.position().row(j);
    const Vector velocity = samples.velocity().row(j);
    const double inverse_speed = 1.0 / std::sqrt(velocity.squaredNorm() + soft_speed2_);
    const Vector heading = inverse_speed * velocity;
    Vector by_base = Vector::Zero();
    Vector by_heading = Vector::Zero();
    for (const Cover& cover : cover_) {
      Vector centre = base + cover.ahead_m * heading;
      if constexpr (D == 2) centre += cover.left_m * left_of(heading);
      const Vector by_centre = add_at(centre, cover.safety_distance_m, rows.value[j]);
      by_base += by_centre;
      by_heading += cover.ahead_m * by_centre;
      if constexpr (D == 2) by_heading -= cover.left_m * left_of(by_centre);
    }
    rows.by_position().row(j) += by_base;
    rows.by_velocity().row(j) += inverse_speed * (by_heading - heading.dot(by_heading) * heading);
  }

  double weight_;
  const ObstacleField<D>& field_;
  std::vector<Cover> cover_;
  double soft_speed2_;
  double reach_m_ = 0.0;
  Derivatives wanted_ = kPosition;
};

}  // namespace mocha
