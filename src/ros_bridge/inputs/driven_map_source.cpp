#include "ros_bridge/inputs/driven_map_source.h"

#include <mocha_ugv/GetKeyframes.h>
#include <ros/service.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "perception/pose_graph/scan_grid.h"
#include "ros_bridge/messages/pose_graph_messages.h"
#include "ros_bridge/runtime/callback_queue.h"

namespace mocha {
namespace {

// Of a keyframe, since it is in the map; less is not seen in cells.
constexpr double kMoved_m = 0.03;
constexpr double kMoved_rad = 0.01;
constexpr double kGhostCell_m = 0.05;

bool has_moved(const Pose& from, const Pose& to) {
  return (to.position - from.position).norm() > kMoved_m ||
         std::abs(wrap_angle(to.yaw_rad - from.yaw_rad)) > kMoved_rad;
}

/// Inserts all keyframes, without the hits of things that moved.
void insert(const std::vector<ScanHits>& scans, const std::vector<Pose>& poses, OccupancyMap& map) {
  std::vector<ScanKeyframe> keyframes(poses.size());
  std::vector<PlacedKeyframe> placed;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    keyframes[i].scan = scans[i];
    placed.push_back({static_cast<int>(i), poses[i], &keyframes[i]});
  }
  const OccupancyGrid all =
      grid_of(placed, Vector2::Zero(), std::numeric_limits<double>::max(), kGhostCell_m);
  for (const PlacedKeyframe& keyframe : placed) map.insert_scan(lasting_beams(keyframe, all));
}

}  // namespace

DrivenMapSource::DrivenMapSource(ros::NodeHandle& node, std::string frame,
                                 const OccupancyMapOptions& options,
                                 std::function<void(OccupancyMap*)> ended)
    : frame_(std::move(frame)),
      service_(node.resolveName("get_keyframes")),
      options_(options),
      ended_(std::move(ended)),
      graphs_(node.subscribe("pose_graph", 5, &DrivenMapSource::on_graph, this)) {}

DrivenMapSource::~DrivenMapSource() {
  if (work_.valid()) work_.wait();
}

void DrivenMapSource::on_graph(const mocha_ugv::PoseGraph& message) {
  try {
    if (message.header.frame_id != frame_)
      throw std::invalid_argument("pose_graph is in frame `" + message.header.frame_id + "`");
    poses_ = poses_of(message);
    fault_.clear();
  } catch (const std::invalid_argument& error) {
    fault_ = error.what();
    return;
  }
  if (work_.valid()) return;
  if (poses_.size() < mapped_.size()) {
    begin_another_map();
  } else {
    add_seen();
    if (is_due()) begin();
  }
}

/// A single one that is new was seen when it was taken.
void DrivenMapSource::add_seen() {
  if (poses_.size() == mapped_.size() + 1) mapped_.push_back(poses_.back());
}

/// Keyframes have become fewer: scan_localizer has begun anew.
void DrivenMapSource::begin_another_map() {
  mapped_.clear();
  scans_.clear();
  begin();
}

bool DrivenMapSource::is_due() const {
  if (poses_.size() != mapped_.size()) return true;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (has_moved(mapped_[i], poses_[i])) return true;
  }
  return false;
}

void DrivenMapSource::begin() {
  under_way_ = poses_;
  work_ = std::async(std::launch::async, [this, scans = std::move(scans_), poses = poses_] {
    Made made = make(service_, options_, scans, poses);
    call_soon([this] { finish(); });
    return made;
  });
  scans_.clear();
}

DrivenMapSource::Made DrivenMapSource::make(const std::string& service,
                                            const OccupancyMapOptions& options, Scans scans,
                                            const std::vector<Pose>& poses) {
  Made made{std::move(scans), nullptr, {}};
  try {
    mocha_ugv::GetKeyframes call;
    call.request.first = static_cast<std::uint32_t>(made.scans.size());
    if (made.scans.size() < poses.size() && !ros::service::call(service, call))
      throw std::invalid_argument(service + " does not answer");
    for (const mocha_ugv::MapKeyframe& keyframe : call.response.keyframes)
      made.scans.push_back(from_message(keyframe));
    if (made.scans.size() < poses.size())
      throw std::invalid_argument(service + " has fewer keyframes than were announced");
    made.map = std::make_unique<OccupancyMap>(options);
    insert(made.scans, poses, *made.map);
  } catch (const std::exception& error) {
    made.map.reset();
    made.fault = error.what();
  }
  return made;
}

void DrivenMapSource::finish() {
  Made made = work_.get();
  fault_ = made.fault;
  scans_ = std::move(made.scans);
  if (poses_.size() < under_way_.size()) {
    made.map.reset();
    begin_another_map();
  }
  // Where it failed, the next message begins it again.
  if (made.map) {
    ++made_;
    mapped_ = std::move(under_way_);
    add_seen();
    if (is_due()) begin();
  }
  ended_(made.map.get());
}

}  // namespace mocha
