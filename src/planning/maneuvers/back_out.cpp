#include "planning/maneuvers/back_out.h"

#include <algorithm>
#include <cmath>

#include "planning/candidates/speed_profile.h"
#include "safety/certificate.h"
#include "trajectory/minco.h"
#include "trajectory/time_scaling.h"

namespace mocha {
namespace {

constexpr double kTrailStep_m = 0.2;  // closer points of the trail are noise of the pose
constexpr double kKnotSpacing_m = 0.3;
constexpr double kSlow_mps = 0.8;         // backward, where the lidar may not see
constexpr double kLongestStretch = 10.0;  // of the time that the profile asks for
constexpr double kSlower = 1.2;
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
  const InitialKnots<2> knots = spread_knots<2>(back, 0.0, slow, kKnotSpacing_m);
  const int last = static_cast<int>(knots.path.cols()) - 1;
  const double acceleration = 0.5 * slow.max_acceleration;
  PlanarMinco::State from;
  PlanarMinco::State to;
  from << knots.path.col(0), Vector2::Zero(), acceleration * away;
  to << knots.path.col(last), Vector2::Zero(),
      -acceleration * (knots.path.col(last) - knots.path.col(last - 1)).normalized();
  PlanarMinco minco;
  minco.resize(last);
  minco.solve(from, to, knots.path.middleCols(1, last - 1), knots.durations_s);
  const PlanarPath curve = minco.curve();
  const auto stretch =
      smallest_stretch(curve, {slow.max_speed, slow.max_acceleration, kLongestStretch});
  if (!stretch) return std::nullopt;
  // A wavering trail may ask for more yaw rate than there is: drive it more slowly.
  for (double slower = *stretch; slower <= kLongestStretch; slower *= kSlower) {
    Motion motion(start_time_s, {DrivePhase{-1, curve.stretched(slower)}});
    if (!check_limits(motion, limits, start_time_s)) return motion;
  }
  return std::nullopt;
}

}  // namespace mocha
