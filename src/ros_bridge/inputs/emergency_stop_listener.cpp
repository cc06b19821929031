#include "ros_bridge/inputs/emergency_stop_listener.h"

#include <utility>

#include "ros_bridge/runtime/transport.h"

namespace mocha {

EmergencyStopListener::EmergencyStopListener(ros::NodeHandle& node, std::function<void()> stopped)
    : on_new_stop_(std::move(stopped)),
      robot_(
          node.subscribe("emergency_stop", 10, &EmergencyStopListener::on_stop, this, at_once())),
      fleet_(node.subscribe("fleet/emergency_stop", 10, &EmergencyStopListener::on_stop, this,
                            at_once())),
      states_(node.subscribe("emergency_stop_state", 10, &EmergencyStopListener::on_state, this,
                             at_once())) {}

std::string EmergencyStopListener::reason() const {
  if (!stopped()) return "";
  if (!latch_.by_itself()) return message_;
  return "emergency stop by " + sender_ +
         ", of which trajectory_broadcaster has not said anything yet; to reset it: rosservice "
         "call " +
         ros::names::resolve("emergency_stop") + " false";
}

void EmergencyStopListener::on_stop(const ros::MessageEvent<const std_msgs::Bool>& event) {
  if (!event.getMessage()->data) return;
  sender_ = event.getPublisherName();
  const bool is_new = !latch_.stopped();
  latch_.stop();
  count_if(is_new);
}

void EmergencyStopListener::count_if(bool is_new) {
  if (!is_new) return;
  ++stops_;
  on_new_stop_();
}

void EmergencyStopListener::on_state(const mocha_ugv::EmergencyStopState& state) {
  message_ = state.message;
  const bool is_new = state.stopped && !latch_.stopped();
  latch_.hear(state.stopped, state.resets);
  count_if(is_new);
}

}  // namespace mocha
