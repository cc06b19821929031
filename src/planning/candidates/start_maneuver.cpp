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
                                             const std::vector<Vector2>& path,
                                             int direction) const {
  StartManeuver start_maneuver;
  start_maneuver.phases = std::move(phases);
  for (const Phase& phase : start_maneuver.phases) start_maneuver.duration_s += duration_s(phase);
  start_maneuver.direction = direction;
  start_maneuver.state << end.position, Vector2::Zero(),
      direction * rest_acceleration(limits_) *
          Vector2(std::cos(end.yaw_rad), std::sin(end.yaw_rad));
  start_maneuver.path = path;
  return start_maneuver;
}

void StartManeuvers::add_from_rest(const std::vector<Phase>& before, const Pose& pose,
                                   const std::vector<Vector2>& path, int direction,
                                   std::vector<StartManeuver>& start_maneuvers) const {
  const double yaw_rad = yaw_of(direction * direction_ahead(path));
  const double change = wrap_angle(yaw_rad - pose.yaw_rad);
  if (std::abs(change) <= std::max(smooth_start_rad_, kNoTurn_rad))
    start_maneuvers.push_back(start_maneuver(before, pose, path, direction));
  if (const auto turning = turn_in_place(pose, yaw_rad, limits_)) {
    std::vector<Phase> phases = before;
    phases.emplace_back(*turning);
    start_maneuvers.push_back(
        start_maneuver(std::move(phases), {pose.position, yaw_rad}, path, direction));
  }
}

std::vector<StartManeuver> StartManeuvers::from_rest(const std::vector<Phase>& before,
                                                     const Pose& pose,
                                                     const std::vector<Vector2>& path,
                                                     Drives drives) const {
  std::vector<StartManeuver> start_maneuvers;
  const double change = wrap_angle(yaw_of(direction_ahead(path)) - pose.yaw_rad);
  if (drives == Drives::kEitherWay && std::abs(change) > M_PI_2)
    add_from_rest(before, pose, path, -1, start_maneuvers);
  add_from_rest(before, pose, path, 1, start_maneuvers);
  return start_maneuvers;
}

std::vector<StartManeuver> StartManeuvers::rolling(const MotionState& state,
                                                   const std::vector<Vector2>& path,
                                                   Drives drives) const {
  const double angle = wrap_angle(yaw_of(direction_ahead(path)) - yaw_of(state.velocity));
  const bool may_go_on = state.speed > 0.0 || (drives == Drives::kEitherWay && state.speed < 0.0);
  if (std::abs(angle) > kRollingStart_rad || !may_go_on) return {};
  StartManeuver start_maneuver;
  start_maneuver.direction = state.speed < 0.0 ? -1 : 1;
  start_maneuver.state << state.pose.position, state.velocity, state.acceleration;
  start_maneuver.path = path;
  return {start_maneuver};
}

}  // namespace mocha
