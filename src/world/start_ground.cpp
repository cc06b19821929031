#include "world/start_ground.h"

#include <cmath>

#include "world/margin_budget.h"

namespace mocha {

StartGround::StartGround(const RobotModel& robot)
    : footprint_(robot.footprint),
      lidar_(robot.lidar),
      around_body_m_(MarginBudget::of(robot).static_margin_m() + robot.map_resolution_m),
      reach_m_(4.0 * robot.footprint.cover_reach_m() + around_body_m_) {}

StartGround StartGround::under_body() const {
  StartGround part = *this;
  part.reach_m_ = footprint_.circumscribed_radius_m() + around_body_m_;
  part.lidar_.field_of_view_rad = 2.0 * M_PI;
  part.lidar_.min_range_m = 0.0;
  return part;
}

bool StartGround::contains(const Vector2& in_body) const {
  if (in_body.norm() > reach_m_) return false;
  return footprint_.depth_m(in_body) >= -around_body_m_ || !lidar_.sees(in_body);
}

}  // namespace mocha
