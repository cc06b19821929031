#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <mocha_ugv/Lease.h>
#include <mocha_ugv/Trajectory.h>
#include <ros/ros.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "control/odometry_check.h"
#include "control/trajectory_tracker.h"
#include "ros_bridge/inputs/emergency_stop_listener.h"
#include "ros_bridge/inputs/pose_source.h"
#include "ros_bridge/messages/committed_trajectory_conversions.h"
#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/runtime/live_parameters.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_stopping_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

constexpr double kPeriod_s = 0.02;

/// Drives the committed motion: trajectories, leases and poses in, velocity commands out.
/// `driven_trajectory` is latched and says which motion that is, or the stop at the end of its
/// lease; without phases: none. A broadcaster that is started anew has to promise that.
class TrajectoryTrackerNode {
 public:
  TrajectoryTrackerNode(ros::NodeHandle& node, const ParameterTable& values)
      : values_(values),
        robot_(robot_identity()),
        model_(own_robot_model(values)),
        max_lease_(values.number("max_lease")),
        tracker_(TrackerParameters::from(values), model_),
        odometry_check_(values.number("max_unanswered_travel"),
                        values.number("frozen_odometry_hold")),
        stop_(node),
        pose_(node, robot_, values.number("max_pose_age"), values.number("max_transform_age")),
        commands_(node.advertise<geometry_msgs::Twist>("cmd_vel", 1)),
        driven_(node.advertise<mocha_ugv::Trajectory>("driven_trajectory", 1, true)),
        errors_(node.advertise<geometry_msgs::Vector3Stamped>("tracking_error", 10)),
        trajectories_(node.subscribe("committed_trajectory", 5,
                                     &TrajectoryTrackerNode::on_trajectory, this, at_once())),
        leases_(node.subscribe("lease", 10, &TrajectoryTrackerNode::on_lease, this, at_once())),
        parameters_(
            values_,
            [this](const ParameterTable& v) { tracker_.set_gains(FeedbackGains::from(v)); }),
        loop_(node, robot_.name, kPeriod_s, [this](ros::Time now) { step(now); }) {
    diagnostics_.setHardwareID(robot_.name);
    diagnostics_.add("tracking", this, &TrajectoryTrackerNode::diagnose);
    tell_driven();
  }

  void stop() {
    commands_.publish(geometry_msgs::Twist());
    ros::WallDuration(0.05).sleep();  // so that it is on its way before the connections close
  }

 private:
  void on_trajectory(const mocha_ugv::Trajectory& message) {
    using mocha_ugv::Trajectory;
    try {
      if (message.agent != robot_.name) throw std::invalid_argument("is for " + message.agent);
      if (message.header.frame_id != robot_.map_frame) {
        throw std::invalid_argument("is in frame " + message.header.frame_id);
      }
      if (message.state != Trajectory::COMMITTED && message.state != Trajectory::EMERGENCY) {
        throw std::invalid_argument("is not committed");
      }
      // The lease comes by itself: a message that was kept for late joiners gives no right to
      // drive.
      tracker_.offer({message.epoch, message.sequence}, from_message(message), 0.0);
    } catch (const std::exception& error) {
      refuse("committed_trajectory", error.what());
    }
  }

  void on_lease(const mocha_ugv::Lease& lease) {
    const double ahead = (lease.valid_until - ros::Time::now()).toSec();
    if (ahead > max_lease_) {
      refuse("lease", "ends " + std::to_string(ahead) + " s from now, more than max_lease");
      return;
    }
    tracker_.renew({lease.epoch, lease.sequence}, lease.valid_until.toSec());
  }

  void refuse(const std::string& topic, const std::string& why) {
    ++refused_;
    refusal_ = topic + ": " + why;
    ROS_WARN_THROTTLE(1.0, "Refused a message on %s", refusal_.c_str());
  }

  void step(ros::Time now) {
    reading_ = pose_.read(now);
    check_odometry(now);
    const TrackerMode before = tracker_.mode();
    const int refused_before = tracker_.refused();
    const int motions_before = tracker_.motions();
    tracker_.set_stopped(stop_.stopped(), stop_.reason());
    command_ = tracker_.step(now.toSec(), reading_.state);
    now_ = now;
    publish();
    if (tracker_.motions() != motions_before) tell_driven();
    if (tracker_.mode() != before) {
      ROS_INFO("%s: %s%s%s", robot_.name.c_str(), to_text(tracker_.mode()),
               tracker_.stop_reason().empty() ? "" : ": ", tracker_.stop_reason().c_str());
    }
    if (tracker_.refused() != refused_before) ROS_WARN("%s", tracker_.refusal().c_str());
    diagnostics_.update();
  }

  /// By what stands though it should move, nothing is driven.
  void check_odometry(ros::Time now) {
    if (!reading_.state) return;
    odometry_check_.add(reading_.state->stamp_s, reading_.in_odom, command_);
    if (!odometry_check_.is_frozen(now.toSec())) return;
    ROS_ERROR_THROTTLE(10.0, "%s: %s", robot_.name.c_str(), odometry_check_.words().c_str());
    reading_.state.reset();
    reading_.missing = odometry_check_.words();
  }

  void tell_driven() {
    mocha_ugv::Trajectory message;
    message.header.stamp = now_;
    message.header.frame_id = robot_.map_frame;
    if (!tracker_.motion().empty()) {
      const double radius_m = model_.footprint.circumscribed_radius_m();
      const TrajectoryId id{tracker_.id().epoch, tracker_.id().sequence};
      const auto motion = std::make_shared<const Motion>(tracker_.motion());
      message = to_message(CommittedTrajectory{robot_.name, id, TrajectoryState::kCommitted, 0,
                                               radius_m, model_.braking(), motion},
                           robot_.map_frame, now_);
    }
    driven_.publish(message);
  }

  void publish() {
    geometry_msgs::Twist twist;
    twist.linear.x = command_.speed;
    twist.angular.z = command_.yaw_rate;
    commands_.publish(twist);
    if (!tracker_.error()) return;
    geometry_msgs::Vector3Stamped error;
    error.header.stamp = now_;
    error.header.frame_id = robot_.base_frame;
    error.vector.x = tracker_.error()->along_m;
    error.vector.y = tracker_.error()->across_m;
    error.vector.z = tracker_.error()->heading_rad;
    errors_.publish(error);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const TrackerMode mode = tracker_.mode();
    const std::string why = mode == TrackerMode::kStale ? reading_.missing : tracker_.stop_reason();
    const bool failed = mode == TrackerMode::kErrorBraking || mode == TrackerMode::kStale ||
                        mode == TrackerMode::kEmergency;
    const bool idle_without_pose = mode == TrackerMode::kIdle && !reading_.state;
    if (odometry_check_.is_frozen(now_.toSec())) {
      status.summary(DiagnosticStatus::ERROR,
                     std::string(to_text(mode)) + ": " + odometry_check_.words());
    } else if (failed) {
      status.summary(DiagnosticStatus::ERROR, std::string(to_text(mode)) + ": " + why);
    } else if (idle_without_pose) {
      status.summary(DiagnosticStatus::WARN, std::string(to_text(mode)) + "; " + reading_.missing);
    } else if (!why.empty()) {
      status.summary(DiagnosticStatus::WARN, std::string(to_text(mode)) + ": " + why);
    } else {
      status.summary(DiagnosticStatus::OK, to_text(mode));
    }
    if (tracker_.error()) {
      status.addf("error along (m)", "%.3f", tracker_.error()->along_m);
      status.addf("error across (m)", "%.3f", tracker_.error()->across_m);
      status.addf("error of the heading (rad)", "%.3f", tracker_.error()->heading_rad);
    }
    if (mode != TrackerMode::kIdle) {
      status.addf("motion (epoch/sequence)", "%u/%u", tracker_.id().epoch, tracker_.id().sequence);
      status.addf("lease remaining (s)", "%.2f", tracker_.lease_end() - now_.toSec());
    }
    status.addf("speed command (m/s)", "%.3f", command_.speed);
    status.addf("yaw rate command (rad/s)", "%.3f", command_.yaw_rate);
    status.addf("odometry age (s)", "%.3f", reading_.odometry_age_s);
    status.addf("map to odom age (s)", "%.3f", reading_.transform_age_s);
    status.add("refused messages", refused_);
    if (refused_ > 0) status.add("last refused message", refusal_);
    status.add("refused motions", tracker_.refused());
    if (tracker_.refused() > 0) status.add("last refused motion", tracker_.refusal());
    parameters_.diagnose(status);
    status.add("refused odometry", pose_.refused());
  }

  ParameterTable values_;
  RobotIdentity robot_;
  RobotModel model_;
  double max_lease_;
  TrajectoryTracker tracker_;
  OdometryCheck odometry_check_;
  EmergencyStopListener stop_;
  PoseSource pose_;
  PoseReading reading_;
  UnicycleState command_ = {0.0, 0.0};
  ros::Time now_;
  int refused_ = 0;
  std::string refusal_;
  diagnostic_updater::Updater diagnostics_;
  ros::Publisher commands_;
  ros::Publisher driven_;
  ros::Publisher errors_;
  ros::Subscriber trajectories_;
  ros::Subscriber leases_;
  LiveParameters parameters_;
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  using Node = mocha::TrajectoryTrackerNode;
  return mocha::run_stopping_node<Node>(argc, argv, "trajectory_tracker", ros::WallDuration(0.02),
                                        [](Node&) {});
}
