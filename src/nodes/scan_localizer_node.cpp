#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <mocha_ugv/Localization.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "perception/localization/learning_localizer.h"
#include "perception/mapping/saved_map.h"
#include "perception/pose_graph/graph_file.h"
#include "perception/pose_graph/mapping_session.h"
#include "ros_bridge/inputs/scan_queue.h"
#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/localization_messages.h"
#include "ros_bridge/messages/sensor_conversions.h"
#include "ros_bridge/outputs/learned_map.h"
#include "ros_bridge/outputs/pose_graph_outputs.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kMemoryPeriod_s = 2.0;
constexpr double kMapSpacing_m = 0.02;  // of hits and misses that enter a map
const std::string kMemory = "last_known_pose";
const Eigen::Vector3d kMemorySigma(0.5, 0.5, 0.3);  // what may have happened meanwhile [m, m, rad]

/// "x y yaw" [m, m, rad], as to_text() writes it.
Pose pose_from_text(const std::string& text) {
  std::istringstream words(text);
  Pose pose;
  std::string rest;
  if (!(words >> pose.position.x() >> pose.position.y() >> pose.yaw_rad) || words >> rest)
    throw ParameterError(kMemory + " = " + text + ": expected x, y and yaw, such as 1.2 0.5 -1.57");
  return pose;
}

std::string to_text(const Pose& pose) {
  std::ostringstream words;
  words << pose.position.x() << " " << pose.position.y() << " " << pose.yaw_rad;
  return words.str();
}

Pose planar(const Eigen::Isometry3d& pose) {
  return {pose.translation().head<2>(), std::atan2(pose(1, 0), pose(0, 0))};
}

/// Scans and odometry in, map -> odom out.
class ScanLocalizerNode {
 public:
  ScanLocalizerNode(ros::NodeHandle& node, const ParameterTable& values)
      : node_(node),
        robot_(robot_identity()),
        model_(own_robot_model(values)),
        mapping_(values.flag("mapping")),
        max_range_m_(values.number("max_range")),
        max_clearing_m_(neighbour_parameters("perception").number("max_clearing_range")),
        hit_spacing_m_(values.number("hit_spacing")),
        timeout_s_(values.number("scan_timeout")),
        queue_(robot_.odom_frame, values.number("scan_rate"), timeout_s_),
        listener_(transforms_, node, false, at_once()),
        poses_(node.advertise<geometry_msgs::PoseWithCovarianceStamped>("localized_pose", 5)),
        states_(node.advertise<mocha_ugv::Localization>("localization", 5, true)),
        scans_(node.subscribe("scan", 20, &ScanLocalizerNode::on_scan, this, at_once())),
        said_(node.subscribe("initialpose", 5, &ScanLocalizerNode::on_initial_pose, this)),
        search_(node.advertiseService("global_localization", &ScanLocalizerNode::on_search, this)),
        loop_(node, robot_.name, kPeriod_s, [this](ros::Time now) { step(now); }) {
    begin(values);
    diagnostics_.setHardwareID(robot_.name);
    diagnostics_.add("localisation", this, &ScanLocalizerNode::diagnose);
  }

 private:
  void begin(const ParameterTable& values) {
    const std::string& path = values.text("map_file");
    if (mapping_ != path.empty()) {
      throw ParameterError(mapping_ ? "parameters `mapping` and `map_file` exclude each other"
                                    : "parameter `map_file` is not set: no map to localise in");
    }
    const auto options = ScanLocalizerOptions::from(values, model_);
    if (mapping_) {
      begin_mapping(GraphMapperOptions::from(values, model_), options,
                    values.text("pose_graph_file"));
      return;
    }
    begin_localizing(options, path, values);
    expect(values.text("last_known_pose"));
  }

  /// In what was learnt of the map, if there is any.
  void begin_localizing(const ScanLocalizerOptions& options, const std::string& path,
                        const ParameterTable& values) {
    const std::string& learned = values.text("learned_map_file");
    if (!learned.empty() && std::filesystem::path(learned).extension() != ".yaml")
      throw ParameterError("learned_map_file = " + learned + ": expected a .yaml file");
    const OccupancyGrid map =
        load_saved_slice(std::filesystem::exists(learned) ? learned : path,
                         values.number("min_height"), values.number("max_height"));
    const double lasting_s = values.number("learn_changes");
    if (lasting_s > 0.0) {
      auto localizer = std::make_unique<LearningLocalizer>(options, map, lasting_s);
      learned_map_.emplace(*localizer, learned);
      localizer_ = std::move(localizer);
    } else {
      auto localizer = std::make_unique<ScanLocalizer>(options);
      localizer->set_map(map);
      localizer_ = std::move(localizer);
    }
  }

  /// In the map of the file, if it is there by now.
  void begin_mapping(const GraphMapperOptions& mapping, const ScanLocalizerOptions& localizing,
                     const std::string& path) {
    DrivenMap map;
    if (!path.empty() && std::filesystem::exists(path)) map = load_driven_map(path);
    auto session = std::make_unique<MappingSession>(mapping, localizing, std::move(map));
    session_ = session.get();
    localizer_ = std::move(session);
    pose_graph_.emplace(node_, robot_, *session_, path);
  }

  void expect(const std::string& last_known) {
    if (last_known.empty()) return;
    const PoseEstimate known{pose_from_text(last_known),
                             kMemorySigma.cwiseProduct(kMemorySigma).asDiagonal()};
    const std::string fault = fault_of(known);
    if (!fault.empty()) throw ParameterError("last_known_pose = " + last_known + ": " + fault);
    localizer_->expect(known);
  }

  /// This node has it again when it is started again.
  void remember(const Pose& pose) {
    if (mapping_ || (now_ - remembered_).toSec() < kMemoryPeriod_s) return;
    remembered_ = now_;
    private_node_.setParam(kMemory, to_text(pose));
  }

  void on_scan(const sensor_msgs::LaserScan& scan) {
    queue_.add(scan, ros::Time::now(), refusals_);
  }

  void on_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    std::string fault;
    const auto said = from_message(message, robot_.map_frame, fault);
    const bool is_known = session_ != nullptr && !session_->is_looking();
    if (!said || is_known) {
      refusals_.add("initialpose: " + (is_known ? "the map is only being made" : fault));
      return;
    }
    localizer_->expect(*said);
    ROS_INFO("Looking for the robot near (%.2f, %.2f)", said->pose.position.x(),
             said->pose.position.y());
  }

  bool on_search(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
    if (mapping_) return false;
    localizer_->forget();
    return true;
  }

  void step(ros::Time now) {
    if (now < now_) forget_time();
    now_ = now;
    if (started_.isZero()) started_ = now;
    for (const Measurement& measurement : queue_.take_ready(transforms_, now, refusals_))
      localize(measurement);
    if (pose_graph_) pose_graph_->step(now);
    if (learned_map_) learned_map_->step(now);
    refusals_.warn();
    diagnostics_.update();
  }

  /// The clock was set back: a recording began again.
  void forget_time() {
    transforms_.clear();
    queue_.clear();
    localizer_->forget();
    started_ = used_ = remembered_ = ros::Time();
  }

  void localize(const Measurement& measurement) {
    const auto* scan = std::get_if<PlanarScan>(&measurement.data);
    if (scan == nullptr || measurement.last <= used_) return;
    try {
      const Pose base = planar(from_message(
          transforms_.lookupTransform(robot_.odom_frame, robot_.base_frame, measurement.last)
              .transform));
      const auto beams = to_beams(*scan, measurement.poses, {max_range_m_, max_clearing_m_});
      ScanHits hits = hits_of(beams, base, mapping_ ? kMapSpacing_m : hit_spacing_m_);
      hits.time_s = measurement.last.toSec();
      const Localization::State before = localizer_->localization().state;
      localizer_->add(hits, base);
      used_ = measurement.last;
      publish(before);
    } catch (const tf2::TransformException& error) {
      refusals_.add("no odometry at the scan's time", error.what());
    } catch (const std::invalid_argument& error) {
      refusals_.add(error.what());
    }
  }

  void publish(Localization::State before) {
    const Localization& localization = localizer_->localization();
    state_ = to_message(localization, robot_);
    states_.publish(state_);
    if (localization.state != before) ROS_INFO("%s", state_.message.c_str());
    if (localization.state != Localization::State::kLocalized) return;
    transform_.sendTransform(map_to_odom(localization, robot_));
    poses_.publish(pose_message(localization, robot_));
    remember(localization.base.pose);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const double silent_s = (now_ - std::max(queue_.received(), started_)).toSec();
    const double blind_s = (now_ - std::max(used_, started_)).toSec();
    if (silent_s > timeout_s_) {
      status.summaryf(DiagnosticStatus::ERROR, "no scan on %s for %.1f s",
                      scans_.getTopic().c_str(), silent_s);
    } else if (blind_s > timeout_s_) {
      status.summaryf(DiagnosticStatus::ERROR, "no scan could be used for %.1f s: %s", blind_s,
                      refusals_.newest().c_str());
    } else if (state_.state != mocha_ugv::Localization::LOCALIZED) {
      status.summary(DiagnosticStatus::ERROR, state_.message);
    } else if (state_.sigma_position > model_.margins.localisation_m) {
      status.summaryf(DiagnosticStatus::WARN, "%s; the model's margin_localisation is %.0f mm",
                      state_.message.c_str(), 1e3 * model_.margins.localisation_m);
    } else {
      status.summary(DiagnosticStatus::OK, state_.message);
    }
    status.add("quality", state_.quality);
    status.add("standard deviation of the position [m]", state_.sigma_position);
    status.add("standard deviation of the heading [rad]", state_.sigma_yaw);
    status.add("places that explain the scans", state_.places);
    for (const auto& [reason, times] : refusals_.counts()) status.add("refused: " + reason, times);
    if (session_ == nullptr) return;
    status.add("keyframes", session_->mapper().graph().size());
    status.add("loops closed", session_->mapper().loops_closed());
  }

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  const RobotIdentity robot_;
  const RobotModel model_;
  const bool mapping_;
  const double max_range_m_;
  const double max_clearing_m_;  // beams that meet nothing
  const double hit_spacing_m_;
  const double timeout_s_;
  std::unique_ptr<Localizer> localizer_;
  MappingSession* session_ = nullptr;  // the localizer, while mapping
  std::optional<PoseGraphOutputs> pose_graph_;
  std::optional<LearnedMap> learned_map_;
  mocha_ugv::Localization state_;

  ScanQueue queue_;
  Refusals refusals_;
  ros::Time now_;
  ros::Time started_;
  ros::Time used_;  // end of the newest scan
  ros::Time remembered_;

  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  tf2_ros::TransformBroadcaster transform_;
  diagnostic_updater::Updater diagnostics_;
  ros::Publisher poses_;
  ros::Publisher states_;
  ros::Subscriber scans_;
  ros::Subscriber said_;
  ros::ServiceServer search_;
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::run_node<mocha::ScanLocalizerNode>(argc, argv, "scan_localizer");
}
