#include "planning/maneuvers/back_out.h"

#include <algorithm>
#include <cmath>

#include "planning/candidates/path_drive.h"

namespace mocha {
namespace {

constexpr double kTrailStep_m = 0.2;  // closer points of the trail are noise of the pose
constexpr double kKnotSpacing_m = 0.3;
constexpr double kSlow_mps = 0.8;    // backward, where the lidar may not see
constexpr double kFromBehind = 0.8;  // cosine between the trail and straight back

/// The trail from `here` backward, thinned out.
std::vector<Vector2> way_back(const std::vector<Vector2>& trail, const Vector2& here,
                              double length_m) {
  std::vector<Vector2> back = {here};
  double length = 0.0;
  for (auto point = trail.rbegin(); point != trail.rend() && length < length_m; ++point) {
    const double step = (*point - back.back()).norm();
    if (step < kTrailStep_m) continue;
    length += step;
    back.push_back(*point);
  }
  return back;
}

}  // namespace

std::optional<Motion> back_out_along(const std::vector<Vector2>& trail, const Pose& pose,
                                     double start_time_s, double length_m,
                                     const MotionLimits& limits) {
  const std::vector<Vector2> back = way_back(trail, pose.position, length_m);
  if (back.size() < 2) return std::nullopt;
  const Vector2 away(-std::cos(pose.yaw_rad), -std::sin(pose.yaw_rad));
  if ((back[1] - back[0]).normalized().dot(away) < kFromBehind) return std::nullopt;
  MotionLimits slow = limits;
  slow.max_speed = std::min(slow.max_speed, kSlow_mps);
  slow.max_acceleration *= 0.5;
  const Vector2 arrival = (back.back() - back[back.size() - 2]).normalized();
  const auto drive = drive_along(back, {-1, away, arrival, kKnotSpacing_m, slow}, limits);
  if (!drive) return std::nullopt;
  return Motion(start_time_s, {*drive});
}

}  // namespace mocha
