#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <string>

#include "stack/known_map.h"
#include "stack/map_order.h"

namespace mocha {

/// The newest of the maps that come in: whole grids, and updates of them, put in order by their
/// stamps. While a grid is waited for the map does not change, but its age grows. Messages come in
/// on one thread.
class MapInput : public KnownMap {
 public:
  /// Maps must be in `frame`. Unusable ones are refused and counted. `ask_anew` asks for a whole
  /// grid that is newer than all that came before.
  explicit MapInput(std::string frame, std::function<void()> ask_anew = {});

  void on_map(const nav_msgs::OccupancyGrid& map);
  void on_update(const map_msgs::OccupancyGridUpdate& update);

  /// Since the stamp of the newest map [s]; infinity before the first.
  double age_s(ros::Time now) const;
  int refused() const { return refused_; }
  /// Grids and updates that were taken.
  int taken() const { return taken_; }

 private:
  using Order = MapOrder<map_msgs::OccupancyGridUpdate>;

  bool is_ours(const std_msgs::Header& header, const char* what);
  void refuse(const char* what, const std::string& why);
  void apply(const Order::Stamped& update);

  const std::string frame_;
  std::atomic<std::uint64_t> stamp_ns_{0};  // of the newest taken
  std::atomic<int> refused_{0};
  std::atomic<int> taken_{0};
  Order order_;
};

/// The newest map of this node's robot, from `map` and `map_updates`.
class MapSource : public MapInput {
 public:
  MapSource(ros::NodeHandle& node, std::string frame);

 private:
  void fetch_whole();

  ros::NodeHandle node_;
  ros::Subscriber maps_;
  ros::Subscriber updates_;
};

}  // namespace mocha
