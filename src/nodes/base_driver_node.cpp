#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <optional>
#include <string>

#include "base/command_watchdog.h"
#include "base/waveshare_base.h"
#include "control/command_limiter.h"
#include "ros_bridge/inputs/emergency_stop_listener.h"
#include "ros_bridge/messages/base_messages.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_stopping_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kLongestStep_s = 0.1;  // that the ramp takes at once
const ros::WallDuration kListenPeriod(0.005);

/// Velocity commands out to the base, its odometry and sensors in.
///
/// The base stands unless a velocity was commanded a short while ago and the base answers. When
/// commands cease, it is slowed down by the ramp; when this node dies, by the firmware's
/// heartbeat. In an emergency stop the wheels are stopped as hard as they can be, then the firmware
/// is told to hold them, until the reset.
class BaseDriverNode {
 public:
  BaseDriverNode(ros::NodeHandle& node, const ParameterTable& values)
      : robot_(robot_identity()),
        model_(own_robot_model(values)),
        low_battery_v_(values.number("low_battery")),
        empty_battery_v_(values.number("empty_battery")),
        base_(WaveshareBase::Options::from(values, model_)),
        watchdog_(model_.cmd_timeout_s),
        limiter_(model_),
        odometry_(node.advertise<nav_msgs::Odometry>("odom", 50)),
        imu_(node.advertise<sensor_msgs::Imu>("imu", 50)),
        battery_(node.advertise<sensor_msgs::BatteryState>("battery", 5)),
        commands_(node.subscribe("cmd_vel", 1, &BaseDriverNode::on_command, this, at_once())),
        stop_(node),
        loop_(node, robot_.name, kPeriod_s, [this](ros::Time now) { step(now); }) {
    if (empty_battery_v_ > low_battery_v_) {
      throw ParameterError("empty_battery = " + std::to_string(empty_battery_v_) +
                           " V, expected no more than low_battery");
    }
    diagnostics_.setHardwareID(robot_.name);
    diagnostics_.add("base", this, &BaseDriverNode::diagnose_base);
    diagnostics_.add("battery", this, &BaseDriverNode::diagnose_battery);
  }

  /// Between the steps: what the base says is not to wait for the next one.
  void listen() { listen(loop_.now()); }

  void stop() {
    for (int i = 0; i < 3; ++i) {
      base_.drive({0.0, 0.0});
      ros::WallDuration(kPeriod_s).sleep();
    }
  }

 private:
  void on_command(const geometry_msgs::Twist& twist) {
    const ros::Time now = loop_.now();
    if (watchdog_.take(now.toSec(), {twist.linear.x, twist.angular.z})) {
      drive(now);
    } else {
      ROS_WARN_THROTTLE(1.0, "Refused a command that is not finite");
    }
  }

  void step(ros::Time now) {
    listen(now);
    const double since_s = (now - driven_).toSec();
    if (since_s < 0.0 || since_s >= kPeriod_s - 1e-6) drive(now);
    diagnostics_.update();
  }

  void listen(ros::Time now) {
    if (now.isZero()) return;  // a simulated clock that has not begun
    const std::vector<BaseFeedback> feedback = base_.poll(now.toSec());
    if (!feedback.empty()) publish(feedback.back());
    const bool connected = base_.connected(now.toSec());
    if (connected == connected_) return;
    connected_ = connected;
    if (connected) {
      ROS_INFO("The base answers on its serial line");
    } else {
      ROS_ERROR("The base is lost: %s", base_.fault(now.toSec()).c_str());
    }
  }

  void drive(ros::Time now) {
    const double dt_s = std::clamp((now - driven_).toSec(), 0.0, kLongestStep_s);
    driven_ = now;
    command_ = stop_.stopped() ? std::nullopt : watchdog_.command(now.toSec());
    if (!base_.connected(now.toSec())) {
      limiter_ = CommandLimiter(model_);  // whatever it did, it stands when it goes on
      base_.drive({0.0, 0.0});
    } else {
      base_.drive(limiter_.limit(command_.value_or(UnicycleState{0.0, 0.0}), dt_s));
    }
    const bool stands = limiter_.last().speed == 0.0 && limiter_.last().yaw_rate == 0.0;
    if (stop_.stopped() && stands) hold(true);
    if (stop_.released()) hold(false);  // what a driver before this one may have left behind, too
  }

  /// By the firmware; not before the wheels have been stopped on their curve.
  void hold(bool held) {
    if (held == held_) return;
    held_ = held;
    base_.set_emergency_stop(held);
    ROS_WARN("Emergency stop: %s", held ? stop_.reason().c_str() : "released");
  }

  void publish(const BaseFeedback& feedback) {
    feedback_ = feedback;
    odometry_.publish(odometry_message(feedback, robot_));
    // tf takes one transform a time; a simulated clock may stand between two lines of feedback.
    if (feedback.stamp_s != transformed_s_) {
      transforms_.sendTransform(odometry_transform(feedback, robot_));
      transformed_s_ = feedback.stamp_s;
    }
    if (feedback.imu) imu_.publish(imu_message(feedback, robot_));
    if (feedback.battery_v) battery_.publish(battery_message(feedback));
  }

  void diagnose_base(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const double now_s = loop_.now().toSec();
    if (!base_.connected(now_s)) {
      status.summary(DiagnosticStatus::ERROR, "the base is lost: " + base_.fault(now_s));
    } else if (stop_.stopped()) {
      status.summary(DiagnosticStatus::ERROR, stop_.reason());
    } else if (!command_) {
      status.summaryf(DiagnosticStatus::OK, "stands: no command on %s for %.2f s",
                      commands_.getTopic().c_str(), model_.cmd_timeout_s);
    } else {
      status.summary(DiagnosticStatus::OK, "drives");
    }
    status.addf("speed sent (m/s)", "%.3f", limiter_.last().speed);
    status.addf("yaw rate sent (rad/s)", "%.3f", limiter_.last().yaw_rate);
    status.add("refused commands", watchdog_.refused());
    for (const auto& [name, value] : base_.details()) status.add(name, value);
  }

  void diagnose_battery(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    if (!feedback_ || !feedback_->battery_v) {
      status.summary(DiagnosticStatus::WARN, "not measured yet");
      return;
    }
    const double voltage = *feedback_->battery_v;
    if (voltage < empty_battery_v_) {
      status.summaryf(DiagnosticStatus::ERROR, "%.2f V: empty", voltage);
    } else if (voltage < low_battery_v_) {
      status.summaryf(DiagnosticStatus::WARN, "%.2f V: low", voltage);
    } else {
      status.summaryf(DiagnosticStatus::OK, "%.2f V", voltage);
    }
  }

  RobotIdentity robot_;
  RobotModel model_;
  double low_battery_v_;
  double empty_battery_v_;
  WaveshareBase base_;
  CommandWatchdog watchdog_;
  CommandLimiter limiter_;
  bool connected_ = false;
  std::optional<bool> held_;  // by the firmware
  ros::Time driven_;
  std::optional<UnicycleState> command_;  // that was driven last
  std::optional<BaseFeedback> feedback_;
  std::optional<double> transformed_s_;  // stamp of the newest transform
  diagnostic_updater::Updater diagnostics_;
  tf2_ros::TransformBroadcaster transforms_;
  ros::Publisher odometry_;
  ros::Publisher imu_;
  ros::Publisher battery_;
  ros::Subscriber commands_;
  EmergencyStopListener stop_;
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  using Node = mocha::BaseDriverNode;
  return mocha::run_stopping_node<Node>(argc, argv, "base_driver", mocha::kListenPeriod,
                                        [](Node& driver) { driver.listen(); });
}
