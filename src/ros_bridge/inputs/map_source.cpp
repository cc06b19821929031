#include "ros_bridge/inputs/map_source.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/map_conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

constexpr int kQueue = 1000;  // updates that wait while a node is busy

}  // namespace

MapInput::MapInput(std::string frame, std::function<void()> ask_anew)
    : frame_(std::move(frame)), order_(std::move(ask_anew)) {}

void MapInput::on_map(const nav_msgs::OccupancyGrid& map) {
  if (!is_ours(map.header, "a map")) return;
  const std::uint64_t stamp_ns = map.header.stamp.toNSec();
  try {
    OccupancyGrid grid = from_message(map);
    if (!order_.admits_grid(stamp_ns)) return;
    take(std::move(grid));
  } catch (const std::exception& error) {
    return refuse("a map", error.what());
  }
  ++taken_;
  stamp_ns_ = stamp_ns;
  for (const Order::Stamped& update : order_.follow(stamp_ns)) apply(update);
}

void MapInput::on_update(const map_msgs::OccupancyGridUpdate& update) {
  const std::uint64_t stamp_ns = update.header.stamp.toNSec();
  order_.hear(update.header.seq, stamp_ns);
  if (!is_ours(update.header, "an update of a map")) return;
  apply({stamp_ns, update.data.empty() && update.width == 0, update});
}

void MapInput::apply(const Order::Stamped& stamped) {
  if (!order_.admits(stamped)) return;
  try {
    take(from_message(stamped.update));
    ++taken_;
    stamp_ns_ = stamped.stamp_ns;
  } catch (const std::exception& error) {
    refuse("an update of a map", error.what());
    order_.start_over();
  }
}

bool MapInput::is_ours(const std_msgs::Header& header, const char* what) {
  if (header.frame_id == frame_) return true;
  refuse(what, "is in frame `" + header.frame_id + "`, not in `" + frame_ + "`");
  return false;
}

void MapInput::refuse(const char* what, const std::string& why) {
  ++refused_;
  ROS_WARN_THROTTLE(5.0, "Refused %s: it %s", what, why.c_str());
}

double MapInput::age_s(ros::Time now) const {
  return available() ? (now - ros::Time().fromNSec(stamp_ns_)).toSec()
                     : std::numeric_limits<double>::infinity();
}

MapSource::MapSource(ros::NodeHandle& node, std::string frame)
    : MapInput(std::move(frame), [this] { fetch_whole(); }), node_(node) {
  updates_ = node_.subscribe("map_updates", kQueue, &MapInput::on_update,
                             static_cast<MapInput*>(this), at_once());
  fetch_whole();
}

/// Subscribes anew: perception sends the whole map to each new subscriber.
void MapSource::fetch_whole() {
  maps_.shutdown();
  maps_ = node_.subscribe("map", 1, &MapInput::on_map, static_cast<MapInput*>(this), at_once());
}

}  // namespace mocha
