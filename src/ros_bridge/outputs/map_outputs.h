#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/single_subscriber_publisher.h>

#include <string>
#include <utility>
#include <vector>

#include "perception/mapping/published_slice.h"

namespace mocha {

/// Publishes a robot's map. The whole map goes to all subscribers of `map` when its place or size
/// changes, and to each new one; other changes go to `map_updates`. While `map` has more
/// subscribers than `map_updates`, each change is published as a whole map. Each publication has a
/// later stamp than the one before, by which subscribers put both topics in order; an update
/// without cells announces a whole map with its stamp.
class MapOutputs {
 public:
  /// Maps are in `frame`.
  MapOutputs(ros::NodeHandle& node, std::string frame);

  /// These areas look occupied from now on, but for an open strip; what changes is published at
  /// once.
  void mark(std::vector<Polygon> keep_out, Strip open) {
    slice_.mark(std::move(keep_out), std::move(open));
  }

  /// Publishes what has changed at most `rate` times a second, and now and then that nothing has,
  /// as long as measurements come in: the newest is of the time `measured`, or zero.
  void publish(OccupancyMap& map, ros::Time now, ros::Time measured, double rate, double border_m);

  /// The clock was set back.
  void forget_time();

 private:
  void serve(const ros::SingleSubscriberPublisher& newcomer);
  void publish_whole();
  void publish_window(const CornerWindow& window);
  nav_msgs::OccupancyGrid whole() const;

  const std::string frame_;
  PublishedSlice slice_;
  bool is_whole_due_ = true;
  bool is_heard_alone_ = false;  // `map`
  ros::Time measured_;           // of the newest map published
  ros::Time published_;          // when that was
  ros::Time stamp_;              // of the newest publication
  std::uint64_t version_ = 0;
  ros::Publisher maps_;
  ros::Publisher updates_;
};

}  // namespace mocha
