#pragma once

#include <cmath>

#include "optimization/body_penalty.h"

namespace mocha {

/// A disc or ball that covers the robot, and the distance d_s that is wished for from its centre.
struct ObstacleCover {
  static constexpr bool kOfSpeed = false;

  double ahead_m;
  double safety_distance_m;
  double left_m = 0.0;

  double reach_m() const { return safety_distance_m; }
  CoverCost cost(double distance_m, double) const {
    const double inverse_ds2 = 1.0 / (safety_distance_m * safety_distance_m);
    const Cubic penalty = cubic(1.0 - distance_m * std::abs(distance_m) * inverse_ds2);
    return {penalty.value, -2.0 * penalty.slope * std::abs(distance_m) * inverse_ds2, 0.0};
  }
};

/// Paper (30): phi(1 - d_r |d_r| / d_s^2), summed over the obstacles r and the discs. d_r is
/// signed, so that a sample inside an obstacle is pushed out as well.
template <int D>
class ObstaclePenalty : public BodyPenalty<D, ObstacleCover> {
 public:
  using Cover = ObstacleCover;

  using BodyPenalty<D, ObstacleCover>::BodyPenalty;

  const char* name() const override { return "obstacle"; }
};

}  // namespace mocha
