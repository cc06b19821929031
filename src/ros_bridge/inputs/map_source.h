#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "stack/known_map.h"

namespace mocha {

/// The newest of the maps that come in: whole grids, and updates of them.
///
/// The two come by different ways, each in order, but either may be ahead. What puts them together
/// are their stamps, which rise from one publication to the next: a grid contains what is not newer
/// than it, and updates that follow a grid which is only announced (by one without cells) wait for
/// it. Where an update is missing or refused, or the stamps fall, a whole grid is asked for anew.
/// Until that comes the map does not change, but its age grows. The first update asks for a grid,
/// too, as earlier ones may have been missed; the map is used in the meantime, as a recording has
/// no other grid to give. Messages come in on one thread.
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
  bool is_ours(const std_msgs::Header& header, const char* what);
  void refuse(const char* what, const std::string& why);
  void heed_order(const std_msgs::Header& header);
  void ask_anew();
  void wait_for_grid();
  void apply(const map_msgs::OccupancyGridUpdate& update);

  const std::string frame_;
  const std::function<void()> ask_anew_;
  std::atomic<std::uint64_t> stamp_ns_{0};  // of the newest taken
  std::atomic<int> refused_{0};
  std::atomic<int> taken_{0};
  ros::Time grid_stamp_;                                // of the newest grid taken
  bool is_waiting_ = true;                              // for a grid
  ros::Time awaited_;                                   // that is at least so new
  bool is_asked_for_ = false;                           // a grid
  std::vector<map_msgs::OccupancyGridUpdate> waiting_;  // that may follow it
  bool has_heard_ = false;                              // an update
  std_msgs::Header heard_;                              // of the newest update, taken or not
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
