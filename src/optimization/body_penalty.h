#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimization/penalty.h"
#include "world/obstacle_field.h"

namespace mocha {

/// What a disc costs at a distance from an obstacle.
struct CoverCost {
  double value;
  double by_distance;  ///< [1/m], at most 0
  double by_speed;     ///< [s/m]
};

/// A cost of the distances between the discs or balls that cover the robot and the obstacles that
/// the field tells apart, summed over both.
///
/// The heading h is the direction of travel, v / sqrt(|v|^2 + e^2): near standstill the discs slide
/// together to the base; the certificate judges the true footprint. In the plane, a disc is centred
/// ahead and to the left of the base, at p + ahead h + left J h; in space along the heading.
///
/// A Cover has `ahead_m`, `left_m` (none in space), a reach_m() beyond which obstacles cost nothing
/// at any speed, cost(distance_m, speed), and kOfSpeed, which says whether the speed counts.
template <int D, typename Cover>
class BodyPenalty : public Penalty<D> {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// `field` must outlive the penalty. `soft_speed` e [m/s] is positive.
  BodyPenalty(double weight, const ObstacleField<D>& field, std::vector<Cover> cover,
              double soft_speed)
      : weight_(weight),
        field_(field),
        cover_(std::move(cover)),
        soft_speed2_(soft_speed * soft_speed) {
    for (const Cover& each : cover_) {
      const double arm_m = std::hypot(each.ahead_m, each.left_m);
      reach_m_ = std::max(reach_m_, arm_m + each.reach_m());
      if (arm_m > 0.0 || Cover::kOfSpeed) wanted_ = kPosition | kVelocity;
    }
  }

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
      add_sample(samples, j, rows);
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

  /// The gradient by the place of a disc's centre, and by the speed.
  struct Slope {
    Vector by_centre = Vector::Zero();
    double by_speed = 0.0;
  };

  Slope add_at(const Vector& centre, const Cover& cover, double speed, double& value) const {
    Slope slope;
    field_.visit_near(centre, cover.reach_m(), [&](const auto& obstacle) {
      const CoverCost cost = cover.cost(obstacle.distance_m, speed);
      value += weight_ * cost.value;
      slope.by_centre += (weight_ * cost.by_distance) * obstacle.gradient;
      slope.by_speed += weight_ * cost.by_speed;
    });
    return slope;
  }

  void add_sample(const PieceSamples<D>& samples, int j, PenaltyRows<D>& rows) const {
    const bool moves = wanted_ & kVelocity;
    const Vector velocity = moves ? Vector(samples.velocity().row(j)) : Vector(Vector::Zero());
    const double speed = std::sqrt(velocity.squaredNorm() + soft_speed2_);
    const Vector heading = velocity / speed;
    Vector by_position = Vector::Zero();
    Vector by_heading = Vector::Zero();
    double by_speed = 0.0;
    for (const Cover& cover : cover_) {
      Vector centre = samples.position().row(j).transpose() + cover.ahead_m * heading;
      if constexpr (D == 2) centre += cover.left_m * left_of(heading);
      const Slope slope = add_at(centre, cover, speed, rows.value[j]);
      by_position += slope.by_centre;
      by_heading += cover.ahead_m * slope.by_centre;
      if constexpr (D == 2) by_heading -= cover.left_m * left_of(slope.by_centre);
      by_speed += slope.by_speed;
    }
    rows.by_position().row(j) += by_position;
    if (!moves) return;
    rows.by_velocity().row(j) +=
        (by_heading - heading.dot(by_heading) * heading) / speed + by_speed * heading;
  }

  double weight_;
  const ObstacleField<D>& field_;
  std::vector<Cover> cover_;
  double soft_speed2_;
  double reach_m_ = 0.0;
  Derivatives wanted_ = kPosition;
};

}  // namespace mocha
