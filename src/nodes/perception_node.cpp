#include <diagnostic_updater/diagnostic_updater.h>
#include <mocha_ugv/FleetTrajectories.h>
#include <mocha_ugv/PredictedObstacles.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "perception/mapping/occupancy_map.h"
#include "perception/sensor/planar_scan.h"
#include "perception/sensor/point_cloud.h"
#include "perception/sensor/range_smoothing.h"
#include "perception/tracking/moving_object_filter.h"
#include "perception/tracking/peer_tracks.h"
#include "ros_bridge/inputs/driven_map_source.h"
#include "ros_bridge/inputs/map_files.h"
#include "ros_bridge/inputs/peer_motions.h"
#include "ros_bridge/inputs/scan_queue.h"
#include "ros_bridge/inputs/sensor_watch.h"
#include "ros_bridge/inputs/zone_controls.h"
#include "ros_bridge/messages/map_conversions.h"
#include "ros_bridge/messages/prediction_conversions.h"
#include "ros_bridge/messages/sensor_conversions.h"
#include "ros_bridge/outputs/map_outputs.h"
#include "ros_bridge/runtime/live_parameters.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"
#include "world/margin_budget.h"
#include "world/robot_model.h"

namespace mocha {
namespace {

constexpr double kPeriod_s = 0.02;

/// Scans and clouds in, occupancy and moving things out.
class PerceptionNode {
 public:
  PerceptionNode(ros::NodeHandle& node, const ParameterTable& values)
      : values_(values),
        robot_(robot_identity()),
        model_(own_robot_model(values)),
        start_ground_(model_),
        map_(OccupancyMapOptions::from(values, model_.map_resolution_m)),
        sensors_(robot_, SensorMonitorOptions::from(values, model_.lidar.noise_m)),
        peers_(values.number("peer_margin"), values.number("peer_timeout")),
        filter_(MovingObjectFilterOptions::from(values)),
        timeout_s_(values.number("scan_timeout")),
        queue_(robot_.map_frame, values.number("integration_rate"), timeout_s_),
        listener_(transforms_, node, false, at_once()),
        maps_(node, robot_.map_frame),
        zones_(node, robot_, model_, values),
        cells_(node.advertise<sensor_msgs::PointCloud2>("occupied_cells", 1)),
        moving_(node.advertise<mocha_ugv::PredictedObstacles>("predicted_obstacles", 5)),
        scans_(node.subscribe("scan", 20, &PerceptionNode::on_scan, this, at_once())),
        points_(node.subscribe("points", 5, &PerceptionNode::on_points, this, at_once())),
        fleet_(
            node.subscribe("fleet/trajectories", 10, &PerceptionNode::on_fleet, this, at_once())),
        map_files_(node, map_, [this](bool is_cleared) { take_map(is_cleared); }),
        driven_(node, robot_.map_frame, map_.options(),
                [this](OccupancyMap* map) { take_driven(map); }),
        parameters_(values_),
        loop_(node, robot_.name, kPeriod_s, [this](ros::Time now) { step(now); }) {
    if (!values.text("map_file").empty()) map_files_.load(values.text("map_file"));
    if (!model_.lidar.sees_all_round())
      ROS_INFO("%s: what its lidar cannot see where it starts is free up to %.2f m away",
               robot_.name.c_str(), start_ground_.reach_m());
    diagnostics_.setHardwareID(robot_.name);
    diagnostics_.add("sensors", this, &PerceptionNode::diagnose_sensors);
    diagnostics_.add("sensor faults", &sensors_, &SensorWatch::diagnose);
    diagnostics_.add("map", this, &PerceptionNode::diagnose_map);
    diagnostics_.add("moving things", this, &PerceptionNode::diagnose_moving);
    diagnostics_.add("zones", &zones_, &ZoneControls::diagnose);
  }

 private:
  void on_scan(const sensor_msgs::LaserScan& scan) {
    queue_.add(scan, ros::Time::now(), refusals_);
  }

  void on_points(const sensor_msgs::PointCloud2& cloud) {
    queue_.add(cloud, ros::Time::now(), refusals_);
  }

  void on_fleet(const mocha_ugv::FleetTrajectories& message) {
    try {
      const PeerReading reading = peers_of(message, robot_.name, robot_.map_frame);
      peers_.update(message.header.stamp.toSec(), reading.motions);
      if (!reading.refused.empty()) refusals_.add("fleet/trajectories", reading.why);
    } catch (const std::invalid_argument& error) {
      refusals_.add("fleet/trajectories", error.what());
    }
  }

  void step(ros::Time now) {
    if (now < now_) forget_time();
    now_ = now;
    if (started_.isZero()) started_ = now;
    for (const Measurement& measurement : queue_.take_ready(transforms_, now, refusals_)) {
      integrate(measurement);
    }
    zones_.step(now, base_at({}), map_, maps_);
    maps_.publish(map_, now, stamp_, values_.number("map_rate"), values_.number("map_border"));
    publish_cells();
    refusals_.warn();
    diagnostics_.update();
    if (driven_.is_busy()) loop_.hold();
  }

  /// The clock was set back: a recording began again.
  void forget_time() {
    transforms_.clear();
    queue_.clear();
    filter_.clear();
    sensors_.clear();
    maps_.forget_time();
    started_ = integrated_ = stamp_ = cells_published_ = ros::Time();
  }

  void integrate(const Measurement& measurement) {
    try {
      const auto base = base_at(measurement.last);
      robot_seen_ = base.has_value();
      clear_peers(measurement.last);
      if (const auto* scan = std::get_if<PlanarScan>(&measurement.data)) {
        auto beams = to_beams(smoothed(*scan, values_.number("smoothing_reach")), measurement.poses,
                              {values_.number("max_range"), values_.number("max_clearing_range")});
        if (base && !beams.empty()) map_.see_robot(*base, start_ground_, blind_walls(beams));
        peers_.ignore_peers(beams);
        filter_.sort(beams, map_);
        sensors_.look(measurement, beams, base, map_, transforms_);
        // What lies is not to enter the map.
        if (!sensors_.stop().empty()) return publish_moving(measurement.last);
        map_.insert_scan(beams);
      } else {
        auto beams = to_beams(std::get<1>(measurement.data), measurement.poses.first,
                              measurement.first.toSec(), values_.number("max_points_range"),
                              map_.options().resolution_m);
        if (base && scans_.getNumPublishers() == 0) map_.see_robot(*base, start_ground_, {});
        peers_.ignore_peers(beams);
        map_.insert_points(beams);
      }
      if (base) map_.clear_body(*base, model_.footprint);
      integrated_ = now_;
      stamp_ = std::max(stamp_, measurement.last);
      publish_moving(stamp_);
    } catch (const std::exception& error) {  // of tf or of the map; neither may stop the node
      refusals_.add(error.what());
    }
  }

  void clear_peers(ros::Time time) {
    for (const auto& disc : peers_.at(time.toSec()))
      map_.clear_disc(disc.centre, disc.radius_m + map_.options().resolution_m);
  }

  std::optional<Pose> base_at(ros::Time time) {
    if (!transforms_.canTransform(robot_.map_frame, robot_.base_frame, time)) return std::nullopt;
    return planar_pose(
        transforms_.lookupTransform(robot_.map_frame, robot_.base_frame, time).transform);
  }

  /// Though nothing moves: their age tells that they can be relied on.
  void publish_moving(ros::Time stamp) {
    auto message =
        to_message(filter_.things(stamp.toSec()), filter_.spread(), robot_.map_frame, stamp);
    message.fault = sensors_.stop();
    moving_.publish(message);
  }

  void publish_cells() {
    if (cells_.getNumSubscribers() == 0 ||
        (now_ - cells_published_).toSec() < 1.0 / values_.number("cells_rate"))
      return;
    sensor_msgs::PointCloud2 message;
    message.header.stamp = now_;
    message.header.frame_id = robot_.map_frame;
    to_message(map_.occupied_voxels(), message);
    cells_.publish(message);
    cells_published_ = now_;
  }

  /// What moved and stood in the map before means nothing in this one.
  void take_map(bool is_cleared) {
    filter_.clear();
    if (!is_cleared) return;
    if (const auto base = base_at({})) map_.see_robot(*base, start_ground_.under_body(), {});
  }

  /// The same places, but for those that have moved.
  void take_driven(OccupancyMap* map) {
    if (map != nullptr) {
      map_.take(*map);
      take_map(true);
    }
    if (!driven_.is_busy()) loop_.release();
  }

  void diagnose_sensors(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const double silent_s = (now_ - std::max(queue_.received(), started_)).toSec();
    const double blind_s = (now_ - std::max(integrated_, started_)).toSec();
    if (silent_s > timeout_s_) {
      status.summaryf(DiagnosticStatus::ERROR, "no scan on %s for %.1f s",
                      scans_.getTopic().c_str(), silent_s);
    } else if (blind_s > timeout_s_ && sensors_.stop().empty()) {
      status.summaryf(DiagnosticStatus::ERROR, "no scan could enter the map for %.1f s: %s",
                      blind_s, refusals_.newest().c_str());
    } else if (!sensors_.stop().empty()) {
      status.summary(DiagnosticStatus::ERROR, "scans do not enter the map: a sensor lies");
    } else {
      status.summary(DiagnosticStatus::OK, "scans enter the map");
    }
    status.add("scans waiting for their transforms", queue_.waiting());
    parameters_.diagnose(status);
    for (const auto& [reason, times] : refusals_.counts()) status.add("refused: " + reason, times);
  }

  void diagnose_map(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    if (robot_seen_) {
      status.summary(DiagnosticStatus::OK, "the robot's place is known");
    } else {
      status.summary(DiagnosticStatus::WARN, "no transform " + robot_.map_frame + " <- " +
                                                 robot_.base_frame +
                                                 ": the ground where it starts is not marked free");
    }
    if (!stamp_.isZero())
      status.add("age of the newest scan in the map [s]", (now_ - stamp_).toSec());
    if (driven_.made() > 0) status.add("maps made anew of moved keyframes", driven_.made());
    if (!driven_.fault().empty()) status.add("pose graph", driven_.fault());
    status.add("team-mates known", peers_.at(now_.toSec()).size());
  }

  void diagnose_moving(diagnostic_updater::DiagnosticStatusWrapper& status) {
    const std::size_t tracks = filter_.moving(stamp_.toSec()).size();
    status.summary(diagnostic_msgs::DiagnosticStatus::OK,
                   tracks == 0 ? "nothing moves" : "tracked");
    status.add("tracks", tracks);
    status.add("hits of the newest scan on moving things", filter_.moving_hits());
  }

  ParameterTable values_;
  const RobotIdentity robot_;
  const RobotModel model_;
  const StartGround start_ground_;
  OccupancyMap map_;
  SensorWatch sensors_;
  PeerTracks peers_;
  MovingObjectFilter filter_;
  const double timeout_s_;

  ScanQueue queue_;
  Refusals refusals_;
  bool robot_seen_ = true;
  ros::Time now_;
  ros::Time started_;
  ros::Time integrated_;
  ros::Time stamp_;  // of the newest measurement in the map
  ros::Time cells_published_;

  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  diagnostic_updater::Updater diagnostics_;
  MapOutputs maps_;
  ZoneControls zones_;
  ros::Publisher cells_;
  ros::Publisher moving_;
  ros::Subscriber scans_;
  ros::Subscriber points_;
  ros::Subscriber fleet_;
  MapFiles map_files_;
  DrivenMapSource driven_;
  LiveParameters parameters_;
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::run_node<mocha::PerceptionNode>(argc, argv, "perception");
}
