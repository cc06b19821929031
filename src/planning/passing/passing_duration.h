#pragma once

#include "planning/passing/passing_order.h"

namespace mocha {

/// How robots drive, as far as it decides which order is quick.
struct PassingPace {
  double speed_mps;
  double acceleration;  ///< [m/s^2]
  double yaw_rate;      ///< [rad/s] of turns in place
  bool may_back;        ///< where a way leads back, they need not turn
  double handover_s;  ///< from the moment at which a robot sets off until those that wait for it do
};

/// How long the order takes, about: until the last robot has made its moves, and a tenth of what
/// all take, which decides between orders that end at the same time. Robots drive on where they
/// need not wait, and the way does not turn back.
double duration_s(const PassingOrder& order, const PassingPace& pace);

}  // namespace mocha
