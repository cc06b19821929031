#pragma once

#include <cmath>
#include <vector>

#include "optimization/penalty.h"
#include "world/obstacle_field.h"

namespace mocha {

/// (30) for the nearest obstacle: phi(1 - d |d| / d_s^2) at the centre of each disc that covers the
/// robot along its heading.
///
/// d is signed, so that a sample inside an obstacle is pushed out as well. The heading is the
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
        soft_speed2_(soft_speed * soft_speed) {}

  const char* name() const override { return "obstacle"; }

  double add(const TrajectorySample<D>& sample, SampleGradient<D>& gradient) const override {
    const double soft_speed = std::sqrt(sample.velocity.squaredNorm() + soft_speed2_);
    const Vector heading = sample.velocity / soft_speed;
    double sum = 0.0;
    for (const Cover& cover : cover_) {
      const auto field = field_.sample(sample.position + cover.offset_m * heading);
      const double inverse_ds2 = 1.0 / (cover.safety_distance_m * cover.safety_distance_m);
      const Cubic penalty =
          cubic(1.0 - field.distance_m * std::abs(field.distance_m) * inverse_ds2);
      if (penalty.value == 0.0) continue;
      sum += weight_ * penalty.value;
      const Vector by_centre =
          (-2.0 * weight_ * penalty.slope * std::abs(field.distance_m) * inverse_ds2) *
          field.gradient;
      gradient.by_position += by_centre;
      gradient.by_velocity +=
          (cover.offset_m / soft_speed) * (by_centre - heading.dot(by_centre) * heading);
    }
    return sum;
  }

 private:
  double weight_;
  const ObstacleField<D>& field_;
  std::vector<Cover> cover_;
  double soft_speed2_;
};

}  // namespace mocha
