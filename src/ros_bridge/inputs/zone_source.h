#pragma once

#include <mocha_ugv/Zones.h>
#include <ros/node_handle.h>

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "world/goal.h"
#include "world/speed_zones.h"

namespace mocha {

/// The zones in force on this node's robot, from `zones`.
class ZoneSource {
 public:
  /// Hears that other zones are in force, and whether some list was known before.
  using Changed = std::function<void(bool were_known)>;

  /// Zones must be in `frame`; others are refused and counted.
  ZoneSource(
      ros::NodeHandle& node, std::string frame, Changed changed = [](bool) {});

  const Zones& zones() const { return zones_; }
  /// Where a robot has to be slow; null: nowhere.
  std::shared_ptr<const SpeedZones> speed_zones(const RobotModel& robot) const {
    return SpeedZones::of(zones_, robot, since_.toSec());
  }
  /// Why the robot may not go to the first of these goals where it may not; empty if it may to all.
  std::string refusal(const std::deque<Goal>& goals) const;
  /// Out of the zone that the robot is in; empty if it is in none.
  const std::vector<Vector2>& exit() const { return exit_; }
  int refused() const { return refused_; }

 private:
  void on_zones(const mocha_ugv::Zones& message);

  const std::string frame_;
  const Changed changed_;
  Zones zones_;
  ros::Time since_;
  bool are_known_ = false;
  std::vector<Vector2> exit_;
  int refused_ = 0;
  ros::Subscriber messages_;
};

}  // namespace mocha
