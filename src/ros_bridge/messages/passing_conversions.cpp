#include "ros_bridge/messages/passing_conversions.h"

#include <stdexcept>

namespace mocha {
namespace {

geometry_msgs::Point point(const Vector2& place) {
  geometry_msgs::Point point;
  point.x = place.x();
  point.y = place.y();
  return point;
}

mocha_ugv::PassingTurn to_message(const PassingTurn& turn) {
  mocha_ugv::PassingTurn message;
  for (const Vector2& place : turn.path) message.path.push_back(point(place));
  for (const PassingProgress& progress : turn.after) {
    message.after.emplace_back();
    message.after.back().robot = progress.robot;
    message.after.back().turns = progress.moves;
  }
  return message;
}

PassingTurn turn_from_message(const mocha_ugv::PassingTurn& message) {
  PassingTurn turn;
  for (const auto& point : message.path) turn.path.emplace_back(point.x, point.y);
  for (const auto& progress : message.after) turn.after.push_back({progress.robot, progress.turns});
  return turn;
}

void require_frame(const std::string& said, const std::string& frame) {
  if (said == frame) return;
  throw std::invalid_argument("is in frame '" + said + "', not in '" + frame + "'");
}

}  // namespace

mocha_ugv::PassingIntent to_message(const PassingIntent& intent, const std::string& frame,
                                    ros::Time stamp) {
  mocha_ugv::PassingIntent message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.agent = intent.agent;
  message.epoch = intent.epoch;
  message.priority = intent.priority;
  message.calls = intent.calls;
  message.radius = intent.radius_m;
  message.has_goal = intent.goal.has_value();
  if (intent.goal) message.goal = point(*intent.goal);
  message.leader = intent.follows.leader;
  message.number = intent.follows.number;
  message.turns = intent.moves;
  for (const Vector2& place : intent.obstacles) message.obstacles.push_back(point(place));
  return message;
}

mocha_ugv::PassingInstruction to_message(const PassingInstruction& instruction,
                                         const std::string& frame, ros::Time stamp) {
  mocha_ugv::PassingInstruction message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.agent = instruction.id.leader;
  message.epoch = instruction.id.epoch;
  message.number = instruction.id.number;
  message.robot = instruction.robot;
  message.robots = instruction.robots;
  message.turns = instruction.turns;
  message.alone_from = instruction.alone_from;
  message.first = instruction.first;
  for (const PassingTurn& turn : instruction.part) message.part.push_back(to_message(turn));
  return message;
}

PassingIntent passing_from_message(const mocha_ugv::PassingIntent& message,
                                   const std::string& frame) {
  require_frame(message.header.frame_id, frame);
  PassingIntent intent;
  intent.agent = message.agent;
  intent.epoch = message.epoch;
  intent.priority = message.priority;
  intent.calls = message.calls != 0;
  intent.radius_m = message.radius;
  if (message.has_goal != 0) intent.goal = Vector2(message.goal.x, message.goal.y);
  intent.follows.leader = message.leader;
  intent.follows.number = message.number;
  intent.moves = message.turns;
  for (const auto& point : message.obstacles) intent.obstacles.emplace_back(point.x, point.y);
  validate(intent);
  return intent;
}

PassingInstruction passing_from_message(const mocha_ugv::PassingInstruction& message,
                                        const std::string& frame) {
  require_frame(message.header.frame_id, frame);
  PassingInstruction instruction;
  instruction.id = {message.agent, message.epoch, message.number};
  instruction.robot = message.robot;
  instruction.robots = message.robots;
  instruction.turns = message.turns;
  instruction.alone_from = message.alone_from;
  instruction.first = message.first;
  for (const auto& turn : message.part) instruction.part.push_back(turn_from_message(turn));
  validate(instruction);
  return instruction;
}

}  // namespace mocha
