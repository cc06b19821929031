#include "ros_bridge/inputs/map_source.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/map_conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

constexpr int kQueue = 1000;               // updates that wait while a node is busy
constexpr std::size_t kMostWaiting = 500;  // updates

}  // namespace

MapInput::MapInput(std::string frame, std::function<void()> ask_anew)
    : frame_(std::move(frame)), ask_anew_(std::move(ask_anew)) {}

void MapInput::on_map(const nav_msgs::OccupancyGrid& map) {
  if (!is_ours(map.header, "a map")) return;
  try {
    OccupancyGrid grid = from_message(map);
    if (map.header.stamp < awaited_) return;
    take(std::move(grid));
  } catch (const std::exception& error) {
    return refuse("a map", error.what());
  }
  ++taken_;
  grid_stamp_ = map.header.stamp;
  stamp_ns_ = grid_stamp_.toNSec();
  is_waiting_ = is_asked_for_ = false;
  awaited_ = ros::Time();
  std::vector<map_msgs::OccupancyGridUpdate> waiting;
  waiting.swap(waiting_);
  for (const auto& update : waiting) apply(update);
}

void MapInput::on_update(const map_msgs::OccupancyGridUpdate& update) {
  heed_order(update.header);
  if (is_ours(update.header, "an update of a map")) apply(update);
}

/// Asks for a grid where the updates, which are numbered, show a gap.
void MapInput::heed_order(const std_msgs::Header& header) {
  const bool is_first = !has_heard_;
  const bool follows = header.seq == heard_.seq + 1 && header.stamp >= heard_.stamp;
  has_heard_ = true;
  heard_ = header;
  if (is_first) {
    ask_anew();
  } else if (!follows) {
    wait_for_grid();
  }
}

void MapInput::ask_anew() {
  is_asked_for_ = true;
  waiting_.clear();
  if (ask_anew_) ask_anew_();
}

void MapInput::wait_for_grid() {
  is_waiting_ = true;
  awaited_ = ros::Time();
  ask_anew();
}

void MapInput::apply(const map_msgs::OccupancyGridUpdate& update) {
  const ros::Time stamp = update.header.stamp;
  if (is_waiting_ || is_asked_for_) waiting_.push_back(update);
  if (waiting_.size() > kMostWaiting) ask_anew();
  if (is_waiting_) return;
  if (stamp <= grid_stamp_) return;  // the grid contains it
  if (update.data.empty() && update.width == 0) {
    is_waiting_ = true;
    awaited_ = stamp;
    return;
  }
  try {
    take(from_message(update));
    ++taken_;
    stamp_ns_ = stamp.toNSec();
  } catch (const std::exception& error) {
    refuse("an update of a map", error.what());
    wait_for_grid();
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
