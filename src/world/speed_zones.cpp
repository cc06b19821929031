#include "world/speed_zones.h"

#include <algorithm>
#include <memory>

#include "world/primitive.h"

namespace mocha {
namespace {

constexpr double kShareOfBraking = 0.8;  // for what a braking motion needs to begin

}  // namespace

std::shared_ptr<const SpeedZones> SpeedZones::of(const Zones& zones, const RobotModel& robot,
                                                 double since_s) {
  SpeedZones slow;
  for (const Zone& zone : zones) {
    if (zone.keeps_out() || zone.max_speed >= robot.limits.max_speed) continue;
    slow.areas_.push_back({zone.name, zone.area, extent(zone.area), zone.max_speed});
  }
  if (slow.areas_.empty()) return nullptr;
  slow.reach_m_ = robot.footprint.circumscribed_radius_m();
  slow.max_speed_ = robot.limits.max_speed;
  slow.deceleration_ = kShareOfBraking * robot.braking().deceleration();
  slow.binds_s_ = since_s + kNotice_s;
  return std::make_shared<const SpeedZones>(std::move(slow));
}

double SpeedZones::limit_at(const Area& area, double t) const {
  return std::max(area.max_speed, max_speed_ - deceleration_ * std::max(0.0, t - binds_s_));
}

double SpeedZones::limit_rate(const Area& area, double t) const {
  return t > binds_s_ && limit_at(area, t) > area.max_speed ? -deceleration_ : 0.0;
}

double SpeedZones::fastest_at(const Vector2& place) const {
  double fastest = max_speed_;
  for (const Area& area : areas_) {
    if (area.box.exteriorDistance(place) < reach_m_ && distance_m(area.area, place) < reach_m_)
      fastest = std::min(fastest, area.max_speed);
  }
  return fastest;
}

}  // namespace mocha
