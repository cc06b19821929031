#pragma once

#include <mocha_ugv/Zones.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <vector>

#include "world/zones.h"

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
  /// Why nobody may go there; empty where one may.
  std::string refusal(const Vector2& place) const;
  /// Out of the zone that the robot is in; empty if it is in none.
  const std::vector<Vector2>& way_out() const { return way_out_; }
  int refused() const { return refused_; }

 private:
  void on_zones(const mocha_ugv::Zones& message);

  const std::string frame_;
  const Changed changed_;
  Zones zones_;
  ros::Time since_;
  bool are_known_ = false;
  std::vector<Vector2> way_out_;
  int refused_ = 0;
  ros::Subscriber messages_;
};

}  // namespace mocha
