#include "ros_bridge/inputs/emergency_stop_controls.h"

#include <exception>
#include <utility>

#include "fleet/storage/stop_store.h"
#include "ros_bridge/messages/emergency_stop_conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

const ros::Duration kKeepAgain(1.0);  // after trouble, or what others say: they may say a lot

}  // namespace

EmergencyStopControls::EmergencyStopControls(ros::NodeHandle& node, const RobotIdentity& robot,
                                             std::uint32_t epoch, std::string file,
                                             Handlers handlers)
    : robot_(robot),
      file_(std::move(file)),
      handlers_(std::move(handlers)),
      stop_(robot.name, epoch, load_stops(file_)),
      states_(node.advertise<mocha_ugv::EmergencyStopState>("emergency_stop_state", 10, true)),
      robot_orders_(
          node.subscribe("emergency_stop", 10, &EmergencyStopControls::on_robot, this, at_once())),
      fleet_orders_(node.subscribe("fleet/emergency_stop", 10, &EmergencyStopControls::on_fleet,
                                   this, at_once())),
      robot_calls_(
          node.advertiseService("emergency_stop", &EmergencyStopControls::on_robot_call, this)),
      fleet_calls_(node.advertiseService("fleet/emergency_stop",
                                         &EmergencyStopControls::on_fleet_call, this)) {
  publish();
}

void EmergencyStopControls::on_robot(const Order& order) {
  if (!order.getMessage()->data) return;
  stop_.stop_robot(ros::Time::now().toSec(), "told by " + order.getPublisherName());
  tell();
  keep();
}

void EmergencyStopControls::on_fleet(const Order& order) {
  if (!order.getMessage()->data) return;
  stop_.stop_fleet(ros::Time::now().toSec(), "told by " + order.getPublisherName());
  tell();
  keep();
}

bool EmergencyStopControls::on_robot_call(Call& call) {
  if (call.getRequest().data) {
    stop_.stop_robot(ros::Time::now().toSec(), "called by " + call.getCallerName());
  } else {
    stop_.reset_robot();
  }
  return answer(call);
}

bool EmergencyStopControls::on_fleet_call(Call& call) {
  const double now_s = ros::Time::now().toSec();
  if (call.getRequest().data) {
    stop_.stop_fleet(now_s, "called by " + call.getCallerName());
  } else {
    stop_.reset_fleet(now_s);
  }
  return answer(call);
}

/// Success is that what was asked for is done; the words say what holds all the same.
bool EmergencyStopControls::answer(Call& call) {
  tell();
  keep();
  const bool reset = !call.getRequest().data;
  call.getResponse().success = true;
  call.getResponse().message = (reset && stop_.stopped() ? "still holds: " : "") + message_;
  if (!trouble_.empty()) call.getResponse().message += ". BUT: " + trouble_;
  return true;
}

void EmergencyStopControls::hear(const FleetStops& message, ros::Time now) {
  stop_.receive(message, now.toSec());
  tell();
}

void EmergencyStopControls::step(ros::Time now) {
  for (const FleetStops& message : stop_.tick(now.toSec())) handlers_.say(message);
  if (now >= keep_again_) keep();
}

void EmergencyStopControls::tell() {
  if (told_ == stop_.changes()) return;
  publish();
  handlers_.changed();
  step(ros::Time::now());
}

void EmergencyStopControls::publish() {
  told_ = stop_.changes();
  const auto state = state_of(stop_, robot_.name, ros::Time::now());
  states_.publish(state);
  if (state.message == message_) return;
  message_ = state.message;
  if (state.stopped) {
    ROS_ERROR("%s: %s", robot_.name.c_str(), message_.c_str());
  } else {
    ROS_INFO("%s: %s", robot_.name.c_str(), message_.c_str());
  }
}

void EmergencyStopControls::keep() {
  if (kept_ == stop_.changes()) return;
  keep_again_ = ros::Time::now() + kKeepAgain;
  try {
    save_stops(file_, stop_.record());
    kept_ = stop_.changes();
    trouble_.clear();
  } catch (const std::exception& error) {
    trouble_ = error.what();
    ROS_ERROR_THROTTLE(10.0, "%s: %s", robot_.name.c_str(), trouble_.c_str());
  }
}

void EmergencyStopControls::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(stop_.stopped() ? DiagnosticStatus::ERROR : DiagnosticStatus::OK, message_);
  if (!trouble_.empty()) status.mergeSummary(DiagnosticStatus::ERROR, trouble_);
  status.add("resets", stop_.record().resets);
  status.add("robots that have stopped the fleet", stop_.record().fleet.size());
  status.add("refused stops of the fleet", stop_.refused());
}

}  // namespace mocha
