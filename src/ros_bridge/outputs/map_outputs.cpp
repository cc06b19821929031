#include "ros_bridge/outputs/map_outputs.h"

#include <algorithm>
#include <utility>

#include "ros_bridge/messages/map_conversions.h"
#include "stack/timing.h"

namespace mocha {
namespace {

constexpr int kQueue = 1000;  // updates that wait for a slow subscriber

}  // namespace

MapOutputs::MapOutputs(ros::NodeHandle& node, std::string frame)
    : frame_(std::move(frame)),
      maps_(node.advertise<nav_msgs::OccupancyGrid>(
          "map", 1, [this](const ros::SingleSubscriberPublisher& newcomer) { serve(newcomer); })),
      updates_(node.advertise<map_msgs::OccupancyGridUpdate>("map_updates", kQueue)) {}

void MapOutputs::publish(OccupancyMap& map, ros::Time now, ros::Time measured, double rate,
                         double border_m) {
  const double since_s = (now - published_).toSec();
  const bool has_changed = map.version() != version_;
  const bool is_fresh = measured > measured_ && since_s >= kMapPeriod_s;
  const bool is_due = (has_changed || is_fresh) && since_s >= 1.0 / rate;
  const bool is_marked_anew = slice_.marks_changed() && !stamp_.isZero();
  if (!is_due && !is_marked_anew) return;
  measured_ = measured.isZero() ? now : measured;
  stamp_ = std::max(measured_, stamp_ + ros::Duration(0, 1));
  published_ = now;
  version_ = map.version();
  const PublishedSlice::Change change = slice_.update(map, border_m);
  if (slice_.grid().cells.empty()) return;
  // Both counts must differ twice: a subscriber does not join or leave both topics at once.
  const bool was_heard_alone = is_heard_alone_;
  is_heard_alone_ = maps_.getNumSubscribers() > updates_.getNumSubscribers();
  if (change.whole || is_whole_due_ || (was_heard_alone && is_heard_alone_)) return publish_whole();
  for (const CornerWindow& window : change.windows) publish_window(window);
  if (change.windows.empty()) publish_window({0, 0, 0, 0});
}

void MapOutputs::forget_time() {
  measured_ = published_ = stamp_ = ros::Time();
  is_whole_due_ = true;
}

/// Sends what was published last, so that the updates that follow fit it.
void MapOutputs::serve(const ros::SingleSubscriberPublisher& newcomer) {
  if (!stamp_.isZero()) newcomer.publish(whole());
}

void MapOutputs::publish_whole() {
  is_whole_due_ = false;
  publish_window({0, 0, -1, -1});
  if (maps_.getNumSubscribers() > 0) maps_.publish(whole());
}

void MapOutputs::publish_window(const CornerWindow& window) {
  if (updates_.getNumSubscribers() == 0) return;
  map_msgs::OccupancyGridUpdate message;
  message.header.stamp = stamp_;
  message.header.frame_id = frame_;
  to_message(cut_out(slice_.grid(), window), message);
  updates_.publish(message);
}

nav_msgs::OccupancyGrid MapOutputs::whole() const {
  nav_msgs::OccupancyGrid message;
  message.header.stamp = message.info.map_load_time = stamp_;
  message.header.frame_id = frame_;
  to_message(slice_.grid(), message);
  return message;
}

}  // namespace mocha
