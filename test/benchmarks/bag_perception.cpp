#include "benchmarks/bag_perception.h"

#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "perception/sensor/blind_wall.h"
#include "perception/sensor/range_smoothing.h"
#include "ros_bridge/messages/sensor_conversions.h"

namespace mocha {
namespace {

constexpr char kConfig[] = "config";
constexpr double kWholeBag_s = 1e6;  // transforms are kept for so long

Pose planar(const Eigen::Isometry3d& pose) {
  return {pose.translation().head<2>(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0))};
}

}  // namespace

BagPerception::BagPerception(const rosbag::Bag& bag, const std::string& map_frame)
    : bag_(bag),
      map_frame_(map_frame),
      values_(ParameterTable::from_schema(std::string(kConfig) + "/perception.yaml")),
      model_(load_robot_model(kConfig, values_.text("robot_model"))),
      start_ground_(model_),
      map_(OccupancyMapOptions::from(values_, model_.map_resolution_m)),
      filter_(MovingObjectFilterOptions::from(values_)),
      transforms_(ros::Duration(kWholeBag_s)) {
  add_transforms();
}

void BagPerception::add_transforms() {
  for (const rosbag::MessageInstance& message : rosbag::View(bag_)) {
    if (const auto label = message.instantiate<geometry_msgs::PoseStamped>())
      labels_[label->header.stamp].push_back(*label);
    const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
    if (!transforms) continue;
    const bool is_static = message.getTopic().find("tf_static") != std::string::npos;
    for (const auto& transform : transforms->transforms)
      transforms_.setTransform(transform, "bag", is_static);
  }
}

void BagPerception::mount(const std::string& frame, const Pose& pose) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = map_frame_;
  transform.child_frame_id = frame;
  transform.transform.translation.x = pose.position.x();
  transform.transform.translation.y = pose.position.y();
  transform.transform.rotation.z = std::sin(0.5 * pose.yaw_rad);
  transform.transform.rotation.w = std::cos(0.5 * pose.yaw_rad);
  transforms_.setTransform(transform, "mount", true);
}

std::vector<BagScan> BagPerception::run() {
  ScanQueue queue(map_frame_, values_.number("integration_rate"), values_.number("scan_timeout"));
  Refusals refusals;
  std::vector<BagScan> scans;
  for (const rosbag::MessageInstance& message : rosbag::View(bag_)) {
    const auto scan = message.instantiate<sensor_msgs::LaserScan>();
    if (!scan) continue;
    queue.add(*scan, message.getTime(), refusals);
    for (const Measurement& measurement :
         queue.take_ready(transforms_, message.getTime(), refusals))
      scans.push_back(take(measurement));
  }
  return scans;
}

/// Where the bag tells of a base.
std::optional<Pose> BagPerception::base_at(ros::Time time) const {
  if (!transforms_.canTransform(map_frame_, "base_link", time)) return std::nullopt;
  return planar_pose(transforms_.lookupTransform(map_frame_, "base_link", time).transform);
}

BagScan BagPerception::take(const Measurement& measurement) {
  const auto& scan = std::get<PlanarScan>(measurement.data);
  const auto base = base_at(measurement.last);
  auto beams = to_beams(smoothed(scan, values_.number("smoothing_reach")), measurement.poses,
                        {values_.number("max_range"), values_.number("max_clearing_range")});
  if (base && !beams.empty()) map_.see_robot(*base, start_ground_, blind_walls(beams));
  filter_.sort(beams, map_);
  map_.insert_scan(beams);
  if (base) map_.clear_body(*base, model_.footprint);
  stamp_s_ = std::max(stamp_s_, measurement.last.toSec());
  BagScan taken{measurement.first.toSec(), stamp_s_, planar(measurement.poses.last),
                filter_.things(stamp_s_),  {},       labels_of(measurement)};
  for (const Beam& beam : beams) {
    if (beam.kind == BeamEnd::kIgnored) taken.moving_hits.push_back(beam);
  }
  return taken;
}

std::vector<PersonLabel> BagPerception::labels_of(const Measurement& measurement) const {
  const auto& scan = std::get<PlanarScan>(measurement.data);
  const auto here = labels_.find(measurement.first);
  std::vector<PersonLabel> labels;
  if (here == labels_.end()) return labels;
  const double sweep_s = scan.end_time_s() - scan.start_time_s;
  for (const geometry_msgs::PoseStamped& label : here->second) {
    const auto& point = label.pose.position;
    const double bearing_rad = std::atan2(point.y, point.x);
    const double share = std::clamp(
        (bearing_rad - scan.angle_min_rad) / (scan.angle_max_rad - scan.angle_min_rad), 0.0, 1.0);
    const Vector3 place = interpolate(measurement.poses, share) * Vector3(point.x, point.y, 0.0);
    labels.push_back(
        {label.header.seq, scan.start_time_s + share * sweep_s, place.head<2>(), bearing_rad});
  }
  return labels;
}

}  // namespace mocha
