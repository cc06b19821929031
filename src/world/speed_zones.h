#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "world/robot_model.h"
#include "world/zones.h"

namespace mocha {

/// Where one robot has to be slow. Map frame, absolute times.
///
/// A zone counts where any of the body may be over it. A robot in which it comes into force has to
/// be let slow down: for a moment nothing is asked, and then the limit comes down from the robot's
/// highest speed to the zone's as fast as it brakes in good time. So whatever is kept to now is
/// kept to at every later moment, and braking at once keeps to it.
class SpeedZones {
 public:
  static constexpr double kNotice_s = 2.0;  ///< to plan anew, and to be bound to that

  struct Area {
    std::string name;
    Obstacle area;
    Eigen::AlignedBox2d box;  ///< that holds it
    double max_speed;
  };

  /// Of the zones that are slower than the robot, in force from `since_s` on; null without any.
  static std::shared_ptr<const SpeedZones> of(const Zones& zones, const RobotModel& robot,
                                              double since_s);

  const std::vector<Area>& areas() const { return areas_; }
  /// Between the base and an area, below which that counts.
  double reach_m() const { return reach_m_; }
  /// What an area asks for at a time.
  double limit_at(const Area& area, double t) const;
  /// How that changes [m/s^2].
  double limit_rate(const Area& area, double t) const;
  /// How fast the base may be at a place, once all zones count.
  double fastest_at(const Vector2& place) const;

 private:
  SpeedZones() = default;

  std::vector<Area> areas_;
  double reach_m_ = 0.0;
  double max_speed_ = 0.0;     // of the robot
  double deceleration_ = 0.0;  // of the limit
  double binds_s_ = 0.0;
};

}  // namespace mocha
