#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimization/penalty.h"
#include "world/obstacle_field.h"

namespace mocha {

/// Paper (30): phi(1 - d_r |d_r| / d_s^2), summed over the obstacles r that the field tells apart,
/// at the centre of each disc that covers the robot along its heading.
///
/// d_r is signed, so that a sample inside an obstacle is pushed out as well. The heading is the
/// direction of travel, v / sqrt(|v|^2 + e^2): near standstill the discs slide together to the
/// base; the certificate judges the true footprint.
template <int D>
class ObstaclePenalty : public Penalty<D> {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// A covering disc or ball: offset along the direction of travel, and the distance d_s [m] to
  /// keep from its centre.
  struct Cover {
    double offset_m;
    double safety_distance_m;
  };

  /// `field` must outlive the penalty. `soft_speed` e [m/s] is positive.
  ObstaclePenalty(double weight, const ObstacleField<D>& field, std::vector<Cover> cover,
                  double soft_speed)
      : weight_(weight),
        field_(field),
        cover_(std::move(cover)),
        soft_speed2_(soft_speed * soft_speed) {
    for (const Cover& each : cover_) {
      reach_m_ = std::max(reach_m_, std::abs(each.offset_m) + each.safety_distance_m);
      if (each.offset_m != 0.0) wanted_ = kPosition | kVelocity;
    }
  }

  const char* name() const override { return "obstacle"; }

  Derivatives wanted(const PieceBounds<D>& piece) const override {
    return field_.clear(piece.box, reach_m_) ? kNone : wanted_;
  }

  void add(const PieceSamples<D>& samples, PenaltyRows<D>& rows) const override {
    const double step_m = std::sqrt(samples.bounds.max_speed2) * samples.bounds.duration_s /
                          std::max(1, samples.size() - 1);
    for (int j = 0; j < samples.size();) {
      const double room_m = field_.room(samples.position().row(j), reach_m_);
      if (room_m > 0.0) {
        const bool to_the_end = !(room_m < step_m * samples.size());
        j += to_the_end ? samples.size() : 1 + static_cast<int>(room_m / step_m);
        continue;
      }
      for (const Cover& cover : cover_) {
        if (cover.offset_m == 0.0) {
          add_ball(samples, j, cover, rows);
        } else {
          add_along_heading(samples, j, cover, rows);
        }
      }
      ++j;
    }
  }

 private:
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

  void add_ball(const PieceSamples<D>& samples, int j, const Cover& cover,
                PenaltyRows<D>& rows) const {
    const Vector centre = samples.position().row(j);
    rows.by_position().row(j) += add_at(centre, cover.safety_distance_m, rows.value[j]);
  }

  void add_along_heading(const PieceSamples<D>& samples, int j, const Cover& cover,
                         PenaltyRows<D>& rows) const {
    const Vector velocity = samples.velocity().row(j);
    const double soft_speed = std::sqrt(velocity.squaredNorm() + soft_speed2_);
    const Vector heading = velocity / soft_speed;
    const Vector centre = samples.position().row(j).transpose() + cover.offset_m * heading;
    const Vector by_centre = add_at(centre, cover.safety_distance_m, rows.value[j]);
    rows.by_position().row(j) += by_centre;
    rows.by_velocity().row(j) +=
        (cover.offset_m / soft_speed) * (by_centre - heading.dot(by_centre) * heading);
  }

  double weight_;
  const ObstacleField<D>& field_;
  std::vector<Cover> cover_;
  double soft_speed2_;
  double reach_m_ = 0.0;
  Derivatives wanted_ = kPosition;
};

}  // namespace mocha
