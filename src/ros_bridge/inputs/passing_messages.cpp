#include "ros_bridge/inputs/passing_messages.h"

#include <stdexcept>
#include <utility>

#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

const ros::Duration kShown(1.5);  // unless it is said again

}  // namespace

PassingMessages::PassingMessages(ros::NodeHandle& node, const RobotIdentity& identity,
                                 std::function<void(const PassingMessage&)> hear)
    : identity_(identity),
      hear_(std::move(hear)),
      drawing_(identity.name),
      intents_out_(node.advertise<mocha_ugv::PassingIntent>("passing_intent", 10)),
      instructions_out_(node.advertise<mocha_ugv::PassingInstruction>("passing_instruction", 100)),
      drawings_(node.advertise<visualization_msgs::MarkerArray>("passing_markers", 2)),
      intents_in_(node.subscribe("fleet/passing_intents", 100, &PassingMessages::on_intent, this,
                                 at_once())),
      instructions_in_(node.subscribe("fleet/passing_instructions", 100,
                                      &PassingMessages::on_instruction, this, at_once())) {}

void PassingMessages::send(const PassingMessage& message, ros::Time now) {
  drawing_.note(message);
  if (const auto* intent = std::get_if<PassingIntent>(&message)) {
    intents_out_.publish(to_message(*intent, identity_.map_frame, now));
    draw(now);
    return;
  }
  const auto& instruction = std::get<PassingInstruction>(message);
  instructions_out_.publish(to_message(instruction, identity_.map_frame, now));
}

void PassingMessages::draw(ros::Time now) {
  Drawing drawing(identity_.map_frame, now);
  drawing_.draw(drawing);
  visualization_msgs::MarkerArray markers = drawing.markers();
  for (auto& marker : markers.markers) marker.lifetime = kShown;
  drawings_.publish(markers);
}

void PassingMessages::on_intent(const mocha_ugv::PassingIntent& message) {
  take(message, "fleet/passing_intents");
}

void PassingMessages::on_instruction(const mocha_ugv::PassingInstruction& message) {
  take(message, "fleet/passing_instructions");
}

template <typename Message>
void PassingMessages::take(const Message& message, const char* topic) {
  try {
    const PassingMessage heard = passing_from_message(message, identity_.map_frame);
    drawing_.note(heard);
    hear_(heard);
  } catch (const std::invalid_argument& error) {
    ++refused_;
    ROS_WARN_THROTTLE(1.0, "Refused a message on %s: %s", topic, error.what());
  }
}

}  // namespace mocha
