#include "simulation/blame.h"

#include <Eigen/Geometry>

namespace mocha {
namespace {

constexpr double kStanding_mps = 0.1;

/// However near the place is.
bool looks_towards(const LidarModel& lidar, const Vector2& place, const Pose& base) {
  const Vector2 in_body = Eigen::Rotation2Dd(-base.yaw_rad) * (place - base.position);
  const Vector2 beam = in_body - lidar.mount.position;
  return lidar.sees(lidar.mount.position + lidar.max_range_m * beam.normalized());
}

}  // namespace

const char* to_text(Blame blame) {
  switch (blame) {
    case Blame::kOwn:
      return "its own";
    case Blame::kStanding:
      return "standing";
    case Blame::kUnseen:
      return "run into unseen";
  }
  return "unknown";
}

Vector2 velocity_at(const Vector2& place, const Pose& base, const Twist& twist) {
  const Vector2 arm = place - base.position;
  const Vector2 ahead = Eigen::Rotation2Dd(base.yaw_rad) * Vector2::UnitX();
  return twist.speed * ahead + twist.yaw_rate * Vector2(-arm.y(), arm.x());
}

Blame blame_of(const Touch& touch, const Pose& base, const LidarModel& lidar) {
  if (touch.own_velocity.norm() <= kStanding_mps) return Blame::kStanding;
  const bool is_run_into =
      touch.own_velocity.dot(touch.towards) <= kStanding_mps && touch.approach_mps() > 0.0;
  if (is_run_into && !looks_towards(lidar, touch.place, base)) return Blame::kUnseen;
  return Blame::kOwn;
}

}  // namespace mocha
