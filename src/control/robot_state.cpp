#include "control/robot_state.h"

#include <cmath>

namespace mocha {
namespace {

constexpr double kStanding_mps = 0.03;
constexpr double kStanding_radps = 0.05;

}  // namespace

Pose predict(const RobotState& state, double t) {
  const double elapsed = t - state.stamp_s;
  const double turned = state.twist.yaw_rate * elapsed;
  // Chord of the arc: its direction is the mean heading, its length shrinks by sinc of half the
  // turn.
  const double half = 0.5 * turned;
  const double sinc = std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  const double mean_yaw = state.pose.yaw_rad + half;
  const double chord = state.twist.speed * elapsed * sinc;
  Pose pose;
  pose.position = state.pose.position + chord * Vector2(std::cos(mean_yaw), std::sin(mean_yaw));
  pose.yaw_rad = wrap_angle(state.pose.yaw_rad + turned);
  return pose;
}

bool stands(const RobotState& state) {
  return std::abs(state.twist.speed) < kStanding_mps &&
         std::abs(state.twist.yaw_rate) < kStanding_radps;
}

}  // namespace mocha
