#pragma once

#include <mocha_ugv/PassingInstruction.h>
#include <mocha_ugv/PassingIntent.h>
#include <ros/ros.h>

#include <functional>
#include <string>

#include "fleet/protocol/passing_messages.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// The broadcaster's ends of what robots say about passing: `passing_intent` and
/// `passing_instruction` of its own global planner, which go out in the own name only, and what was
/// heard from team-mates, on `fleet/passing_intents` and `fleet/passing_instructions`.
class PassingRelay {
 public:
  struct Callbacks {
    std::function<void(const PassingMessage&)> send;
    std::function<void(const std::string& topic, const std::string& why)> refuse;
  };

  PassingRelay(ros::NodeHandle& node, const RobotIdentity& robot, std::uint32_t epoch,
               Callbacks callbacks);

  /// What a team-mate says.
  void publish(const PassingIntent& intent, ros::Time now) const;
  void publish(const PassingInstruction& instruction, ros::Time now) const;

 private:
  void on_intent(const mocha_ugv::PassingIntent& message) { relay(message, "passing_intent"); }
  void on_instruction(const mocha_ugv::PassingInstruction& message) {
    relay(message, "passing_instruction");
  }
  /// To all team-mates, which refuse one in another name.
  template <typename Message>
  void relay(Message message, const std::string& topic) const;

  const RobotIdentity robot_;
  const std::uint32_t epoch_;
  const Callbacks callbacks_;
  ros::Publisher intents_out_;
  ros::Publisher instructions_out_;
  ros::Subscriber intents_;
  ros::Subscriber instructions_;
};

}  // namespace mocha
