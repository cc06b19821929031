#include "world/start_ground.h"

#include <cmath>

#include "world/margin_budget.h"

namespace mocha {

StartGround::StartGround(const RobotModel& robot)
    : footprint_(robot.footprint),
      lidar_(robot.lidar),
      around_body_m_(MarginBudget::of(robot).static_margin_m() + robot.map_resolution_m),
      reach_m_(robot.footprint.cover_reach_m() + around_body_m_) {}

bool StartGround::contains(const Vector2& in_body) const {
  if (in_body.norm() > reach_m_) return false;
  return footprint_.depth_m(in_body) >= -around_body_m_ || !is_seen(in_body);
}

bool StartGround::is_seen(const Vector2& in_body) const {
  const Vector2 beam = in_body - lidar_.mount.position;
  const double angle_rad = wrap_angle(std::atan2(beam.y(), beam.x()) - lidar_.mount.yaw_rad);
  return beam.norm() >= lidar_.min_range_m && std::abs(angle_rad) <= 0.5 * lidar_.field_of_view_rad;
}

}  // namespace mocha
