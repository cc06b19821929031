#include "planning/opening.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {
namespace {

constexpr double kLookAhead_m = 0.3;       // of the path that gives its initial direction
constexpr double kRollingStart_rad = 1.2;  // between velocity and path; beyond, brake first
constexpr double kNoTurn_rad = 0.02;       // smaller changes of heading are left to the drive

Vector2 direction_ahead(const std::vector<Vector2>& path) {
  for (const Vector2& point : path) {
    if ((point - path.front()).norm() >= kLookAhead_m) return point - path.front();
  }
  return path.back() - path.front();
}

double yaw_of(const Vector2& direction) { return std::atan2(direction.y(), direction.x()); }

}  // namespace

Openings::Openings(const MotionLimits& limits, double smooth_start_rad, double rest_acceleration)
    : limits_(limits), smooth_start_rad_(smooth_start_rad), rest_acceleration_(rest_acceleration) {}

std::optional<TurnPhase> Openings::turn(const Pose& pose, double yaw_change_rad) const {
  if (std::abs(yaw_change_rad) <= kNoTurn_rad) return std::nullopt;
  return TurnPhase{
      pose, yaw_change_rad,
      turn_duration_s(yaw_change_rad, limits_.max_yaw_rate, limits_.max_yaw_acceleration)};
}

Opening Openings::opening(std::vector<Phase> phases, const Pose& end,
                          const std::vector<Vector2>& path) const {
  Opening opening;
  opening.phases = std::move(phases);
  for (const Phase& phase : opening.phases) opening.duration_s += duration_s(phase);
  opening.state << end.position, Vector2::Zero(),
      rest_acceleration_ * Vector2(std::cos(end.yaw_rad), std::sin(end.yaw_rad));
  opening.path = path;
  return opening;
}

std::vector<Opening> Openings::from_rest(const std::vector<Phase>& before, const Pose& pose,
                                         const std::vector<Vector2>& path) const {
  const double path_yaw = yaw_of(direction_ahead(path));
  const double change = wrap_angle(path_yaw - pose.yaw_rad);
  std::vector<Opening> openings;
  if (std::abs(change) <= std::max(smooth_start_rad_, kNoTurn_rad))
    openings.push_back(opening(before, pose, path));
  if (const auto turning = turn(pose, change)) {
    std::vector<Phase> phases = before;
    phases.emplace_back(*turning);
    openings.push_back(opening(std::move(phases), {pose.position, path_yaw}, path));
  }
  return openings;
}

std::vector<Opening> Openings::rolling(const MotionState& state,
                                       const std::vector<Vector2>& path) const {
  const double angle = wrap_angle(yaw_of(direction_ahead(path)) - yaw_of(state.velocity));
  if (std::abs(angle) > kRollingStart_rad || !(state.speed > 0.0)) return {};
  Opening opening;
  opening.state << state.pose.position, state.velocity, state.acceleration;
  opening.path = path;
  return {opening};
}

}  // namespace mocha
