#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_srvs/SetBool.h>

#include <functional>
#include <string>

#include "fleet/protocol/emergency_stop.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// The emergency stops of one robot as people and other nodes meet them: the services and topics
/// `emergency_stop` and `fleet/emergency_stop`, and what holds, latched, as `emergency_stop_state`.
/// On a topic, true stops and false says nothing: only the services reset. All is kept in a file
/// before a service answers.
class EmergencyStopControls {
 public:
  struct Handlers {
    std::function<void(const FleetStops&)> say;  ///< to the fleet
    std::function<void()> changed;               ///< what holds is not what it was
  };

  EmergencyStopControls(ros::NodeHandle& node, const RobotIdentity& robot, std::uint32_t epoch,
                        std::string file, Handlers handlers);

  /// A validated message of a team-mate.
  void hear(const FleetStops& message, ros::Time now);
  void step(ros::Time now);

  bool stopped() const { return stop_.stopped(); }
  /// Which stops hold and how to reset them.
  const std::string& message() const { return message_; }
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  using Order = ros::MessageEvent<const std_msgs::Bool>;
  using Call = ros::ServiceEvent<std_srvs::SetBool::Request, std_srvs::SetBool::Response>;

  void on_robot(const Order& order);
  void on_fleet(const Order& order);
  bool on_robot_call(Call& call);
  bool on_fleet_call(Call& call);
  bool answer(Call& call);
  /// Tells all what has changed.
  void tell();
  void publish();
  /// Writes to the file what has changed.
  void keep();

  const RobotIdentity robot_;
  const std::string file_;
  const Handlers handlers_;
  EmergencyStop stop_;
  int told_ = 0;
  int kept_ = 0;
  std::string message_;
  std::string trouble_;  // with the file
  ros::Time keep_again_;
  ros::Publisher states_;
  ros::Subscriber robot_orders_;
  ros::Subscriber fleet_orders_;
  ros::ServiceServer robot_calls_;
  ros::ServiceServer fleet_calls_;
};

}  // namespace mocha
