#pragma once

#include "trajectory/bernstein.h"
#include "trajectory/pose.h"

namespace mocha {

/// How a heading changes at one time.
struct TurnRates {
  double yaw_rate = 0.0;          ///< [rad/s]
  double yaw_acceleration = 0.0;  ///< [rad/s^2]
};

/// Turn in place with a quintic heading profile: from rest to rest, or a part of such a turn.
/// Positive change is counter-clockwise.
struct TurnPhase {
  Pose start;
  double yaw_change_rad;
  double duration_s;
  TurnRates from = {};  ///< at its start
  TurnRates to = {};    ///< at its end
};

/// Returns the change of heading since the start [rad], over the turn's time in [0, 1].
Bernstein<1, 5> yaw_change(const TurnPhase& turn);

/// The heading [rad], wrapped into (-pi, pi], and how it changes at time t [s] within the turn.
struct TurnState {
  double yaw_rad;
  TurnRates rates;
};
TurnState state_of(const TurnPhase& turn, double t);

/// Returns the turn between two times within it [s]; `from_s` is less than `until_s`.
TurnPhase part_of(const TurnPhase& turn, double from_s, double until_s);

/// Returns how a turn that is under way comes to rest, to the same side: at `deceleration`
/// [rad/s^2], which is above 0, or as hard as its rate changes already, where that is harder.
TurnPhase turn_to_rest(const Pose& pose, const TurnRates& rates, double deceleration);

/// Returns the duration of the quintic turn by `yaw_change_rad` from rest to rest within the limits
/// of rate [rad/s] and acceleration [rad/s^2], with a thousandth to spare for what messages round.
double turn_duration_s(double yaw_change_rad, double max_yaw_rate, double max_yaw_acceleration);

}  // namespace mocha
