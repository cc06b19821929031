#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>

#include <string>

#include "stack/known_map.h"

namespace mocha {

/// The newest of the maps that come in.
class MapInput : public KnownMap {
 public:
  /// Maps must be in `frame`. Unusable ones are refused and counted.
  explicit MapInput(std::string frame);

  void on_map(const nav_msgs::OccupancyGrid& map);

  /// Since the stamp of the newest map [s]; infinity before the first.
  double age_s(ros::Time now) const;
  int refused() const { return refused_; }

 private:
  std::string frame_;
  ros::Time stamp_;
  int refused_ = 0;
};

/// The newest map of this node's robot, from `map`.
class MapSource : public MapInput {
 public:
  MapSource(ros::NodeHandle& node, std::string frame);

 private:
  ros::Subscriber maps_;
};

}  // namespace mocha
