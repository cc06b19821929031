#pragma once

#include <memory>
#include <vector>

#include "optimization/penalty.h"
#include "world/moving_obstacle.h"

namespace mocha {

/// (33)(39): phi(1 - d_n^2 / d_s^2) for each moving disc at the absolute time of the sample, where
/// d_s = own radius + its radius + clearance.
class MovingPenalty : public Penalty<2> {
 public:
  struct Other {
    std::shared_ptr<const MovingObstacle> obstacle;
    double until_s;  ///< absolute time after which it is not counted any more (infinity: for ever)
  };

  /// `start_time_s`: absolute time at which the trajectory begins.
  MovingPenalty(double weight, double start_time_s, double own_radius_m, double clearance_m,
                std::vector<Other> others)
      : weight_(weight),
        start_time_s_(start_time_s),
        reach_m_(own_radius_m + clearance_m),
        others_(std::move(others)) {}

  const char* name() const override { return "moving"; }

  double add(const TrajectorySample<2>& sample, SampleGradient<2>& gradient) const override {
    const double now = start_time_s_ + sample.time_s;
    double sum = 0.0;
    for (const Other& other : others_) {
      if (now > other.until_s) continue;
      const MovingObstacle::Disc disc = other.obstacle->at(now);
      const double safety = reach_m_ + disc.radius_m;
      const double inverse_ds2 = 1.0 / (safety * safety);
      const Eigen::Vector2d apart = sample.position - disc.centre;
      const double ratio = apart.squaredNorm() * inverse_ds2;
      const Cubic penalty = cubic(1.0 - ratio);
      if (penalty.value == 0.0) continue;
      sum += weight_ * penalty.value;
      const double scale = weight_ * penalty.slope;
      gradient.by_position -= (2.0 * scale * inverse_ds2) * apart;
      gradient.by_time +=
          2.0 * scale *
          (apart.dot(disc.velocity) * inverse_ds2 + ratio * disc.radius_rate / safety);
    }
    return sum;
  }

 private:
  double weight_;
  double start_time_s_;
  double reach_m_;
  std::vector<Other> others_;
};

}  // namespace mocha
