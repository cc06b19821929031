#include "world/start_ground.h"

#include "world/margin_budget.h"

namespace mocha {

StartGround::StartGround(const RobotModel& robot)
    : footprint_(robot.footprint),
      lidar_(robot.lidar),
      around_body_m_(MarginBudget::of(robot).static_margin_m() + robot.map_resolution_m),
      // At a wall, the body has to back off by the difference before it can turn.
      reach_m_(2.0 * robot.footprint.cover_reach_m() - robot.footprint.inscribed_radius_m() +
               around_body_m_) {}

bool StartGround::contains(const Vector2& in_body) const {
  if (in_body.norm() > reach_m_) return false;
  return footprint_.depth_m(in_body) >= -around_body_m_ || !lidar_.sees(in_body);
}

}  // namespace mocha
