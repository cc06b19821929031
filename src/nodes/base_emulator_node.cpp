#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/runtime/node_help.h"
#include "ros_bridge/runtime/node_start.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"
#include "simulation/base_emulator.h"
#include "simulation/pseudo_terminal.h"
#include "simulation/vehicle.h"

namespace mocha {
namespace {

constexpr double kPeriod_s = 0.01;
const ros::WallDuration kListenPeriod(0.002);

/// What the wheels of an emulated base move.
class Chassis {
 public:
  virtual ~Chassis() = default;
  /// Drives the wheels so from now on.
  virtual void drive(double now_s, const UnicycleState& wheels) = 0;
  /// What the wheels saw since the last call: the arc rolled, and the twist at its end.
  virtual Arc roll(double now_s) = 0;
  virtual UnicycleState twist() const = 0;
};

/// A vehicle of its own on an empty plane, whose true pose is told on `~truth`.
class OwnChassis : public Chassis {
 public:
  OwnChassis(const RobotModel& model, const RobotIdentity& robot)
      : robot_(robot),
        vehicle_(model, Pose{}),
        truth_(ros::NodeHandle("~").advertise<nav_msgs::Odometry>("truth", 50)) {}

  void drive(double now_s, const UnicycleState& wheels) override {
    vehicle_.command(now_s, {wheels.speed, wheels.yaw_rate});
  }

  Arc roll(double now_s) override {
    const double dt_s = now_s - time_s_.value_or(now_s);
    time_s_ = now_s;
    if (!(dt_s > 0.0)) return {};
    const Arc arc = vehicle_.step(now_s - dt_s, dt_s);
    nav_msgs::Odometry truth;
    truth.header.stamp = ros::Time(now_s);
    truth.header.frame_id = robot_.map_frame;
    truth.child_frame_id = robot_.base_frame;
    truth.pose.pose = to_message(vehicle_.pose());
    truth.twist.twist.linear.x = twist().speed;
    truth.twist.twist.angular.z = twist().yaw_rate;
    truth_.publish(truth);
    return arc;
  }

  UnicycleState twist() const override {
    return {vehicle_.twist().speed, vehicle_.twist().yaw_rate};
  }

 private:
  RobotIdentity robot_;
  Vehicle vehicle_;
  std::optional<double> time_s_;
  ros::Publisher truth_;
};

/// This robot in the fleet simulator, which drives it by `wheels/cmd_vel` and says what its wheels
/// saw, slip and all, on `wheels/odom`.
class SimulatedChassis : public Chassis {
 public:
  explicit SimulatedChassis(ros::NodeHandle& node)
      : commands_(node.advertise<geometry_msgs::Twist>("wheels/cmd_vel", 1)),
        odometry_(
            node.subscribe("wheels/odom", 5, &SimulatedChassis::on_odometry, this, at_once())) {}

  void drive(double, const UnicycleState& wheels) override {
    geometry_msgs::Twist twist;
    twist.linear.x = wheels.speed;
    twist.angular.z = wheels.yaw_rate;
    commands_.publish(twist);
  }

  Arc roll(double) override {
    const Arc rolled = rolled_;
    rolled_ = {};
    return rolled;
  }

  UnicycleState twist() const override { return twist_; }

 private:
  void on_odometry(const nav_msgs::Odometry& message) {
    const Pose pose = from_message(message.pose.pose);
    const Arc arc = arc_between(pose_.value_or(pose), pose);
    rolled_ = {rolled_.length_m + arc.length_m, rolled_.turn_rad + arc.turn_rad};
    pose_ = pose;
    twist_ = {message.twist.twist.linear.x, message.twist.twist.angular.z};
  }

  std::optional<Pose> pose_;
  Arc rolled_;
  UnicycleState twist_ = {0.0, 0.0};
  ros::Publisher commands_;
  ros::Subscriber odometry_;
};

/// No two gearboxes are alike: the right wheel has a tenth more friction.
BaseEmulator::Options firmware_options(const ParameterTable& values) {
  constexpr double kUneven = 1.1;
  const double breakaway_pwm = values.number("breakaway_pwm");
  const double friction_pwm = values.number("friction_pwm");
  if (breakaway_pwm < friction_pwm) {
    throw ParameterError("breakaway_pwm = " + std::to_string(breakaway_pwm) +
                         ", allowed is no less than friction_pwm");
  }
  return {values.flag("holds_emergency_stop"),
          {breakaway_pwm, friction_pwm},
          {kUneven * breakaway_pwm, kUneven * friction_pwm}};
}

/// A Waveshare UGV on a pseudo-terminal: its firmware, and what its wheels move.
///
/// With the fleet simulator behind it, the stack of a robot runs as on the robot: base_driver
/// speaks through the serial line, and nothing else of the robot is told. In every step of the
/// simulator's clock the emulator hears what has come through the line, has the simulator's vehicle
/// driven as the firmware would drive it, and answers with what the simulator says that the wheels
/// did; then it acknowledges the step. The line itself is not in lockstep, as no serial line is:
/// what one side writes in a step, the other reads in the same or in the next.
class BaseEmulatorNode {
 public:
  BaseEmulatorNode(ros::NodeHandle& node, const ParameterTable& values)
      : robot_(robot_identity()),
        model_(own_robot_model(values)),
        firmware_(ros::Time::now().toSec(), firmware_options(values)),
        terminal_(link_of(values)),
        restart_(
            ros::NodeHandle("~").advertiseService("restart", &BaseEmulatorNode::on_restart, this)) {
    if (values.text("vehicle") == "own") {
      chassis_ = std::make_unique<OwnChassis>(model_, robot_);
    } else {
      chassis_ = std::make_unique<SimulatedChassis>(node);
    }
    ROS_INFO("The serial line of %s is %s (%s)", robot_.name.c_str(), link_of(values).c_str(),
             terminal_.path().c_str());
    loop_ = std::make_unique<StepLoop>(node, robot_.name, kPeriod_s,
                                       [this](ros::Time now) { step(now); });
  }

  /// Between the steps: commands are not to wait for the next one.
  void listen() {
    const std::string bytes = terminal_.read();
    if (bytes.empty()) return;
    const double now_s = loop_->now().toSec();
    firmware_.receive(now_s, bytes);
    drive(now_s);
  }

 private:
  std::string link_of(const ParameterTable& values) const {
    const std::string& link = values.text("link");
    return link.empty() ? "/tmp/" + robot_.name + "_base" : link;
  }

  bool on_restart(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    firmware_.restart(loop_->now().toSec());
    response.success = true;
    response.message = "restarted";
    return true;
  }

  void step(ros::Time now) {
    const double now_s = now.toSec();
    firmware_.receive(now_s, terminal_.read());
    const double speed_before = chassis_->twist().speed;
    roll(now_s);
    const UnicycleState twist = chassis_->twist();
    const double dt_s = now_s - stepped_s_.value_or(now_s);
    stepped_s_ = now_s;
    firmware_.feel(dt_s > 0.0 ? (twist.speed - speed_before) / dt_s : 0.0, twist.yaw_rate);
    drive(now_s);
    terminal_.write(firmware_.send(now_s));
  }

  void roll(double now_s) {
    const Arc arc = chassis_->roll(now_s);
    const double track = model_.limits.track_m;
    const WheelSpeeds rolled = wheel_speeds({arc.length_m, arc.turn_rad}, track);  // per step
    firmware_.roll(rolled.left, rolled.right, wheel_speeds(chassis_->twist(), track));
  }

  void drive(double now_s) {
    chassis_->drive(now_s, from_wheel_speeds(firmware_.wheels(now_s), model_.limits.track_m));
  }

  RobotIdentity robot_;
  RobotModel model_;
  BaseEmulator firmware_;
  PseudoTerminal terminal_;
  std::unique_ptr<Chassis> chassis_;
  std::optional<double> stepped_s_;
  ros::ServiceServer restart_;
  std::unique_ptr<StepLoop> loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (mocha::prints_help(argc, argv, "base_emulator")) return 0;
  const mocha::NodeStart start(argc, argv, "base_emulator");
  ros::NodeHandle node;
  std::unique_ptr<mocha::BaseEmulatorNode> emulator;
  const auto make = [&] {
    emulator = std::make_unique<mocha::BaseEmulatorNode>(
        node, mocha::read_parameters(ros::NodeHandle("~"), "base_emulator"));
  };
  return start.run(make, [&] {
    while (ros::ok()) {
      ros::getGlobalCallbackQueue()->callAvailable(mocha::kListenPeriod);
      emulator->listen();
    }
  });
}
