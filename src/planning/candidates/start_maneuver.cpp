#include "planning/candidates/start_maneuver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {
namespace {

constexpr double kLookAhead_m = 0.3;  // of the path that gives its initial direction
constexpr double kNoTurn_rad = 0.02;  // smaller changes of heading are left to the drive

Vector2 direction_ahead(const std::vector<Vector2>& path) {
  for (const Vector2& point : path) {
    if ((point - path.front()).norm() >= kLookAhead_m) return point - path.front();
  }
  return path.back() - path.front();
}

double yaw_of(const Vector2& direction) { return std::atan2(direction.y(), direction.x()); }

}  // namespace

double rest_acceleration(const MotionLimits& limits) { return 0.5 * limits.max_acceleration; }

std::optional<TurnPhase> turn_in_place(const Pose& pose, double yaw_rad,
                                       const MotionLimits& limits) {
  const double change_rad = wrap_angle(yaw_rad - pose.yaw_rad);
  if (std::abs(change_rad) <= kNoTurn_rad) return std::nullopt;
  return TurnPhase{pose, change_rad,
                   turn_duration_s(change_rad, limits.max_yaw_rate, limits.max_yaw_acceleration)};
}

StartManeuver StartManeuvers::start_maneuver(std::vector<Phase> phases, const Pose& end,
                                             const std::vector<Vector2>& path) const {
  StartManeuver start_maneuver;
  start_maneuver.phases = std::move(phases);
  for (const Phase& phase : start_maneuver.phases) start_maneuver.duration_s += duration_s(phase);
  start_maneuver.state << end.position, Vector2::Zero(),
      rest_acceleration(limits_) * Vector2(std::cos(end.yaw_rad), std::sin(end.yaw_rad));
  start_maneuver.path = path;
  return start_maneuver;
}

std::vector<StartManeuver> StartManeuvers::from_rest(const std::vector<Phase>& before,
                                                     const Pose& pose,
                                                     const std::vector<Vector2>& path) const {
  const double path_yaw = yaw_of(direction_ahead(path));
  const double change = wrap_angle(path_yaw - pose.yaw_rad);
  std::vector<StartManeuver> start_maneuvers;
  if (std::abs(change) <= std::max(smooth_start_rad_, kNoTurn_rad))
    start_maneuvers.push_back(start_maneuver(before, pose, path));
  if (const auto turning = turn_in_place(pose, path_yaw, limits_)) {
    std::vector<Phase> phases = before;
    phases.emplace_back(*turning);
    start_maneuvers.push_back(start_maneuver(std::move(phases), {pose.position, path_yaw}, path));
  }
  return start_maneuvers;
}

std::vector<StartManeuver> StartManeuvers::rolling(const MotionState& state,
                                                   const std::vector<Vector2>& path) const {
  const double angle = wrap_angle(yaw_of(direction_ahead(path)) - yaw_of(state.velocity));
  if (std::abs(angle) > kRollingStart_rad || !(state.speed > 0.0)) return {};
  StartManeuver start_maneuver;
  start_maneuver.state << state.pose.position, state.velocity, state.acceleration;
  start_maneuver.path = path;
  return {start_maneuver};
}

}  // namespace mocha
