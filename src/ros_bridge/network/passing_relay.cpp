#include "ros_bridge/network/passing_relay.h"

#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/passing_conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {

PassingRelay::PassingRelay(ros::NodeHandle& node, const RobotIdentity& robot, std::uint32_t epoch,
                           Callbacks callbacks)
    : robot_(robot),
      epoch_(epoch),
      callbacks_(std::move(callbacks)),
      intents_out_(node.advertise<mocha_ugv::PassingIntent>("fleet/passing_intents", 100)),
      instructions_out_(
          node.advertise<mocha_ugv::PassingInstruction>("fleet/passing_instructions", 100)),
      intents_(node.subscribe("passing_intent", 10, &PassingRelay::on_intent, this, at_once())),
      instructions_(node.subscribe("passing_instruction", 100, &PassingRelay::on_instruction, this,
                                   at_once())) {}

void PassingRelay::publish(const PassingIntent& intent, ros::Time now) const {
  intents_out_.publish(to_message(intent, robot_.map_frame, now));
}

void PassingRelay::publish(const PassingInstruction& instruction, ros::Time now) const {
  instructions_out_.publish(to_message(instruction, robot_.map_frame, now));
}

template <typename Message>
void PassingRelay::relay(Message message, const std::string& topic) const {
  try {
    if (message.agent != robot_.name) {
      throw std::invalid_argument("is of '" + message.agent + "'");
    }
    message.epoch = epoch_;
    callbacks_.send(passing_from_message(message, robot_.map_frame));
  } catch (const std::invalid_argument& error) {
    callbacks_.refuse(topic, error.what());
  }
}

}  // namespace mocha
