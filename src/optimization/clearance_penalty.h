#pragma once

#include "optimization/body_penalty.h"
#include "world/speed_margin.h"

namespace mocha {

/// A disc or ball that covers the robot, and the distance d_v that proofs require from its centre.
struct ClearanceCover {
  static constexpr bool kOfSpeed = true;

  double ahead_m;
  SpeedMargin required;
  double max_speed;  ///< [m/s]
  double left_m = 0.0;

  double reach_m() const { return required.at(max_speed); }
  CoverCost cost(double distance_m, double speed) const {
    constexpr double kSteep_m = 0.01;
    constexpr double kMost = 8.0;
    const Cubic lacking = cubic((required.at(speed) - distance_m) / kSteep_m);
    const double share = 1.0 / (1.0 + lacking.value / kMost);
    const double slope = lacking.slope * share * share / kSteep_m;
    return {lacking.value * share, -slope, 2.0 * slope * required.per_speed2 * speed};
  }
};

/// x / (1 + x / 8) of x = phi((d_v - d_r) / 1 cm) with d_v = d_0 + c |v|^2, summed over the
/// obstacles r and the discs: as steep as a limit, and level where more than a few centimetres
/// lack, from where ObstaclePenalty leads out. It makes the robot pass a narrow place as slowly as
/// it must, and no slower.
template <int D>
class ClearancePenalty : public BodyPenalty<D, ClearanceCover> {
 public:
  using Cover = ClearanceCover;

  using BodyPenalty<D, ClearanceCover>::BodyPenalty;

  const char* name() const override { return "clearance"; }
};

}  // namespace mocha
