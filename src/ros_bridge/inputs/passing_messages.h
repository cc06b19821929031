#pragma once

#include <ros/ros.h>

#include <functional>
#include <string>

#include "ros_bridge/messages/passing_conversions.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/rviz/passing_drawing.h"

namespace mocha {

/// A global planner's ends of what robots tell each other about passing: `passing_intent` and
/// `passing_instruction` go out by way of the broadcaster, `fleet/passing_intents` and
/// `fleet/passing_instructions` are those of the team-mates.
class PassingMessages {
 public:
  /// What no team-mate can have meant is refused and counted.
  PassingMessages(ros::NodeHandle& node, const RobotIdentity& identity,
                  std::function<void(const PassingMessage&)> hear);

  /// Says it, and with each intent shows in rviz what the robot is to do.
  void send(const PassingMessage& message, ros::Time now);
  int refused() const { return refused_; }

 private:
  void on_intent(const mocha_ugv::PassingIntent& message);
  void on_instruction(const mocha_ugv::PassingInstruction& message);
  template <typename Message>
  void take(const Message& message, const char* topic);
  void draw(ros::Time now);

  const RobotIdentity identity_;
  const std::function<void(const PassingMessage&)> hear_;
  PassingDrawing drawing_;
  int refused_ = 0;
  ros::Publisher intents_out_;
  ros::Publisher instructions_out_;
  ros::Publisher drawings_;
  ros::Subscriber intents_in_;
  ros::Subscriber instructions_in_;
};

}  // namespace mocha
