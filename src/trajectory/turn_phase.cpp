#include "trajectory/turn_phase.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kForRounding = 1.001;  // a message that rounds a turn keeps it within its limits

template <int N>
double value_at(const Bernstein<1, N>& control, double u) {
  return split(control, u).second[0];
}

/// Returns about the highest yaw acceleration of the turn [rad/s^2].
double hardest(const TurnPhase& turn) {
  constexpr int kLooks = 32;
  const Bernstein<1, 3> acceleration = derivative(derivative(yaw_change(turn)));
  double most = 0.0;
  for (int i = 0; i <= kLooks; ++i)
    most = std::max(most, std::abs(value_at<3>(acceleration, static_cast<double>(i) / kLooks)));
  return most / (turn.duration_s * turn.duration_s);
}

/// Returns the turn to rest within that time; its rate follows the cubic between the ends.
TurnPhase to_rest(const Pose& pose, const TurnRates& rates, double duration_s) {
  const double change_rad =
      duration_s * (rates.yaw_rate / 2.0 + rates.yaw_acceleration * duration_s / 12.0);
  return {pose, change_rad, duration_s, rates, {}};
}

}  // namespace

Bernstein<1, 5> yaw_change(const TurnPhase& turn) {
  const double step_s = turn.duration_s / 5.0;
  const double bend_s2 = turn.duration_s * turn.duration_s / 20.0;
  Bernstein<1, 5> control;
  control[0] = 0.0;
  control[1] = step_s * turn.from.yaw_rate;
  control[2] = 2.0 * control[1] + bend_s2 * turn.from.yaw_acceleration;
  control[5] = turn.yaw_change_rad;
  control[4] = turn.yaw_change_rad - step_s * turn.to.yaw_rate;
  control[3] = 2.0 * control[4] - turn.yaw_change_rad + bend_s2 * turn.to.yaw_acceleration;
  return control;
}

TurnState state_of(const TurnPhase& turn, double t) {
  const double u = std::clamp(t / turn.duration_s, 0.0, 1.0);
  const Bernstein<1, 5> change = yaw_change(turn);
  const Bernstein<1, 4> rate = derivative(change);
  const double acceleration = value_at<3>(derivative(rate), u);
  return {
      wrap_angle(turn.start.yaw_rad + value_at<5>(change, u)),
      {value_at<4>(rate, u) / turn.duration_s, acceleration / (turn.duration_s * turn.duration_s)}};
}

TurnPhase part_of(const TurnPhase& turn, double from_s, double until_s) {
  const Bernstein<1, 5> change = yaw_change(turn);
  const double from_rad = value_at<5>(change, std::max(0.0, from_s / turn.duration_s));
  const double until_rad = value_at<5>(change, std::min(1.0, until_s / turn.duration_s));
  const TurnState begin = state_of(turn, from_s);
  return {{turn.start.position, begin.yaw_rad},
          until_rad - from_rad,
          until_s - from_s,
          begin.rates,
          state_of(turn, until_s).rates};
}

TurnPhase turn_to_rest(const Pose& pose, const TurnRates& rates, double deceleration) {
  constexpr double kPeak = 1.5;  // of a cubic from a steady rate to rest, against its mean
  constexpr double kLonger = 1.1;
  constexpr double kLeast_s = 0.02;  // messages round what is shorter too much
  constexpr double kRounding = 1.0 + 1e-9;
  const double most = kRounding * std::max(deceleration, std::abs(rates.yaw_acceleration));
  double duration_s = std::max(kLeast_s, kPeak * std::abs(rates.yaw_rate) / most);
  TurnPhase braking = to_rest(pose, rates, duration_s);
  while (hardest(braking) > most) braking = to_rest(pose, rates, duration_s *= kLonger);
  return braking;
}

double turn_duration_s(double yaw_change_rad, double max_yaw_rate, double max_yaw_acceleration) {
  // Peaks of the quintic: rate 15/8 change/T at the middle, acceleration 10/sqrt(3) change/T^2.
  const double change = kForRounding * std::abs(yaw_change_rad);
  return std::max(1.875 * change / max_yaw_rate,
                  std::sqrt(10.0 / std::sqrt(3.0) * change / max_yaw_acceleration));
}

}  // namespace mocha
