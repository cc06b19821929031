#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "ros_bridge/messages/simulation_messages.h"
#include "ros_bridge/runtime/footprint_check.h"
#include "ros_bridge/runtime/live_parameters.h"
#include "ros_bridge/runtime/lockstep.h"
#include "ros_bridge/runtime/node_help.h"
#include "ros_bridge/runtime/node_start.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/simulated_time.h"
#include "ros_bridge/runtime/transport.h"
#include "ros_bridge/rviz/world_markers.h"
#include "simulation/world_simulator.h"

namespace mocha {
namespace {

const ros::Time kStart(1.0);  // never 0, which ROS takes for "no time yet"
constexpr double kTruthPeriod_s = 0.02;
constexpr double kMarkerPeriod_s = 0.1;
constexpr double kDiagnosticsPeriod_s = 1.0;  // wall time

AckRoster lockstep_roster(const World& world, const std::string& nodes) {
  AckRoster roster;
  for (const WorldRobot& robot : world.robots) {
    std::istringstream list(nodes);
    for (std::string node; std::getline(list, node, ',');) {
      node.erase(0, node.find_first_not_of(' '));
      node.erase(node.find_last_not_of(' ') + 1);
      if (node.empty()) continue;
      std::string fault;
      if (!ros::names::validate(node, fault)) {
        throw ParameterError("parameter `lockstep_nodes`: `" + node +
                             "` is no node's name: " + fault);
      }
      roster.expect(robot.name, node);
    }
  }
  return roster;
}

World load_fleet(const ParameterTable& values) {
  const std::string& path = values.text("world");
  if (path.empty()) throw ParameterError("parameter `world` is not set: no world file");
  World world = load_world(path, config_path(""));
  if (world.robots.empty()) throw WorldError(path + ": robots: there are none");
  return world;
}

/// True once every period of simulated time.
class Due {
 public:
  explicit Due(double period_s) : period_(period_s) {}
  bool at(ros::Time now) {
    if (now < next_) return false;
    while (next_ <= now) next_ = next_.isZero() ? now + period_ : next_ + period_;
    return true;
  }

 private:
  ros::Duration period_;
  ros::Time next_;
};

/// Where nothing follows the simulator's clock, it follows that of the machine.
ros::Time start_time() { return ros::Time::isSimTime() ? kStart : ros::Time::now(); }

/// Simulated seconds per wall second: bounded above, and measured.
class Pace {
 public:
  /// `rate` 0: no bound. On the machine's clock: that rate, and no other.
  Pace(double rate, ros::Time start)
      : on_machine_clock_(!ros::Time::isSimTime()),
        rate_(on_machine_clock_ ? 1.0 : rate),
        last_(start) {}

  /// As the constructor's, from now on.
  void set_rate(double rate) {
    if (!on_machine_clock_) rate_ = rate;
  }

  /// Serves callbacks until the next step may begin. A step that came late makes the following ones
  /// hurry on the machine's clock only.
  void wait(double step_s) {
    if (rate_ == 0.0) return;
    next_ += ros::WallDuration(step_s / rate_);
    if (!on_machine_clock_) next_ = std::max(next_, ros::WallTime::now());
    serve_until(next_, [] { return false; });
  }

  /// Since the last call.
  double measured(ros::Time now) {
    const ros::WallTime wall = ros::WallTime::now();
    const double factor = (now - last_).toSec() / (wall - last_wall_).toSec();
    last_ = now;
    last_wall_ = wall;
    return factor;
  }

 private:
  bool on_machine_clock_;
  double rate_;
  ros::WallTime next_ = ros::WallTime::now();
  ros::Time last_;
  ros::WallTime last_wall_ = ros::WallTime::now();
};

/// The fleet's world: velocity commands in, clock, sensors and the truth out.
class FleetSimulatorNode {
 public:
  FleetSimulatorNode(ros::NodeHandle& node, const ParameterTable& values)
      : values_(values),
        step_(values.number("step")),
        publish_map_to_odom_(values.flag("publish_map_to_odom")),
        emulated_bases_(values.flag("emulated_bases")),
        has_stacks_(ros::Time::isSimTime() && !values.text("lockstep_nodes").empty()),
        world_path_(values.text("world")),
        now_(start_time()),
        simulator_(load_fleet(values), now_.toSec(), values.integer("seed")),
        pace_(values.number("rate"), now_),
        lockstep_(
            node,
            lockstep_roster(simulator_.world(), has_stacks_ ? values.text("lockstep_nodes") : ""),
            ros::WallDuration(values.number("start_timeout")),
            ros::WallDuration(values.number("ack_timeout"))),
        truth_(node.advertise<mocha_ugv::GroundTruth>("/fleet_simulator/ground_truth", 100)),
        contacts_(node.advertise<mocha_ugv::Contact>("/fleet_simulator/contacts", 100)),
        markers_(
            node.advertise<visualization_msgs::MarkerArray>("/fleet_simulator/world", 1, true)),
        moving_markers_(
            node.advertise<visualization_msgs::MarkerArray>("/fleet_simulator/moving_markers", 10)),
        diagnostics_timer_(node.createWallTimer(ros::WallDuration(kDiagnosticsPeriod_s),
                                                &FleetSimulatorNode::on_diagnostics, this)),
        parameters_(values_, [this](const ParameterTable& v) { apply(v); }) {
    apply(values_);
    std::vector<geometry_msgs::TransformStamped> mounts;
    for (std::size_t i = 0; i < simulator_.robots().size(); ++i) {
      connect(node, i);
      mounts.push_back(base_to_laser(simulator_.robots()[i]));
    }
    static_transforms_.sendTransform(mounts);
    markers_.publish(world_markers(simulator_.world()));
    diagnostics_.setHardwareID("simulation");
    diagnostics_.add("simulation", this, &FleetSimulatorNode::diagnose);
  }

  void run() {
    lockstep_.await_nodes(now_);
    if (has_stacks_) check_footprints(simulator_.world(), world_path_);
    while (ros::ok()) {
      pace_.wait(step_.toSec());
      now_ += step_;
      ++steps_;
      publish(simulator_.step_to(now_.toSec()));
      lockstep_.announce(now_);
    }
  }

 private:
  struct Channel {
    ros::Publisher odometry;
    ros::Publisher scan;
    ros::Subscriber commands;
    ros::Subscriber believed;                ///< odometry of the driver of an emulated base
    nav_msgs::OdometryConstPtr believed_in;  ///< the newest
  };

  void connect(ros::NodeHandle& node, std::size_t robot) {
    const std::string root = "/" + simulator_.robots()[robot].setup.name;
    const std::string base = root + (emulated_bases_ ? "/wheels" : "");
    const boost::function<void(const geometry_msgs::TwistConstPtr&)> on_command =
        [this, robot](const geometry_msgs::TwistConstPtr& twist) { command(robot, *twist); };
    channels_.push_back({node.advertise<nav_msgs::Odometry>(base + "/odom", 50),
                         node.advertise<sensor_msgs::LaserScan>(root + "/scan", 20),
                         node.subscribe<geometry_msgs::Twist>(base + "/cmd_vel", 1, on_command,
                                                              ros::VoidPtr(), at_once()),
                         {},
                         {}});
    if (!emulated_bases_) return;
    const boost::function<void(const nav_msgs::OdometryConstPtr&)> on_odometry =
        [this, robot](const nav_msgs::OdometryConstPtr& odometry) {
          channels_[robot].believed_in = odometry;
        };
    channels_.back().believed = node.subscribe<nav_msgs::Odometry>(root + "/odom", 5, on_odometry,
                                                                   ros::VoidPtr(), at_once());
  }

  void command(std::size_t robot, const geometry_msgs::Twist& twist) {
    if (std::isfinite(twist.linear.x) && std::isfinite(twist.angular.z)) {
      simulator_.command(static_cast<int>(robot), {twist.linear.x, twist.angular.z});
      return;
    }
    ++refused_commands_;
    ROS_WARN_THROTTLE(1.0, "Refused a command for %s that is not finite",
                      simulator_.robots()[robot].setup.name.c_str());
  }

  void apply(const ParameterTable& values) {
    pace_.set_rate(values.number("rate"));
    simulator_.set_fault(values.text("fault_robot"), SensorFault::from(values));
  }

  void publish(const WorldSimulator::StepResult& result) {
    std::vector<geometry_msgs::TransformStamped> transforms;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const SimulatedRobot& robot = simulator_.robots()[i];
      const auto& believed = channels_[i].believed_in;
      if (!emulated_bases_) transforms.push_back(odom_to_base(robot, now_));
      if (publish_map_to_odom_ && !emulated_bases_) {
        transforms.push_back(map_to_odom(robot, now_));
      } else if (publish_map_to_odom_ && believed) {
        transforms.push_back(map_to_odom(robot, *believed, now_));
      }
      channels_[i].odometry.publish(odometry_message(robot, now_));
    }
    if (!transforms.empty()) transforms_.sendTransform(transforms);
    for (const auto& [robot, scan] : result.scans) {
      channels_[robot].scan.publish(scan_message(simulator_.robots()[robot], scan));
    }
    for (const ContactEvent& contact : result.contacts) report(contact);
    if (truth_due_.at(now_)) truth_.publish(ground_truth_message(simulator_, now_));
    if (markers_due_.at(now_)) moving_markers_.publish(moving_markers(simulator_));
  }

  void report(const ContactEvent& contact) {
    ROS_WARN("Contact at %.2f s: %s (%s) with %s at (%.2f, %.2f), %.3f m deep, at %.2f m/s",
             now_.toSec(), contact.robot.c_str(), to_text(contact.blame), contact.other.c_str(),
             contact.touch.place.x(), contact.touch.place.y(), contact.depth_m,
             contact.touch.approach_mps());
    contacts_.publish(contact_message(contact, now_));
  }

  void on_diagnostics(const ros::WallTimerEvent&) { diagnostics_.force_update(); }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    status.summary(DiagnosticStatus::OK, steps_ == 0 ? "waiting for nodes" : "running");
    std::string missing;
    for (const std::string& name : lockstep_.missing())
      missing += (missing.empty() ? "" : ", ") + name;
    if (refused_commands_ > 0) {
      status.mergeSummary(DiagnosticStatus::WARN, "commands were refused: not finite");
    }
    if (!missing.empty()) status.mergeSummary(DiagnosticStatus::WARN, "missing: " + missing);
    status.add("time [s]", now_.toSec());
    status.add("steps", steps_);
    status.add("real-time factor", pace_.measured(now_));
    status.add("missing nodes", missing);
    status.add("refused commands", refused_commands_);
    status.add("sensor fault", values_.text("sensor_fault"));
    parameters_.diagnose(status);
  }

  ParameterTable values_;
  ros::Duration step_;
  bool publish_map_to_odom_;
  bool emulated_bases_;
  bool has_stacks_;  // for which the clock waits
  std::string world_path_;
  ros::Time now_;
  WorldSimulator simulator_;
  Pace pace_;
  Lockstep lockstep_;
  ros::Publisher truth_;
  ros::Publisher contacts_;
  ros::Publisher markers_;
  ros::Publisher moving_markers_;
  ros::WallTimer diagnostics_timer_;
  std::vector<Channel> channels_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  diagnostic_updater::Updater diagnostics_;
  LiveParameters parameters_;
  Due truth_due_{kTruthPeriod_s};
  Due markers_due_{kMarkerPeriod_s};
  long steps_ = 0;
  long refused_commands_ = 0;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (mocha::prints_help(argc, argv, "fleet_simulator")) return 0;
  // Without it there is nothing to wait for: launch files end with it.
  const mocha::NodeStart start(argc, argv, "fleet_simulator", 0, mocha::NodeStart::Fault::kEnds);
  ros::NodeHandle node;
  std::optional<mocha::SimulatedTime> time;
  std::unique_ptr<mocha::FleetSimulatorNode> simulator;
  const auto make = [&] {
    time.emplace();
    const auto values = mocha::read_parameters(ros::NodeHandle("~"), "fleet_simulator");
    if (!ros::Time::isSimTime()) {
      ROS_WARN("/use_sim_time is not true: on the machine's clock, waiting for no node");
    }
    simulator = std::make_unique<mocha::FleetSimulatorNode>(node, values);
  };
  return start.run(make, [&] { simulator->run(); });
}
