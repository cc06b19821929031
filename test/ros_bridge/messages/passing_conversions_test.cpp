#include "ros_bridge/messages/passing_conversions.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace mocha {
namespace {

const ros::Time kStamp(1700000000, 250000000);

PassingIntent intent() {
  return {"ugv1", 3, -7, true, 0.333, Vector2(1.5, -2.25), {"ugv2", 0, 5}, 4};
}

PassingInstruction instruction() {
  PassingInstruction instruction{{"ugv1", 3, 5}, "ugv2", {"ugv1", "ugv2", "ugv3"}, 8, 5, 2, {}};
  instruction.part.push_back({{{0.0, 1.0}, {0.5, 1.0}, {0.5, 2.0}}, {{0, 3}, {2, 1}}});
  instruction.part.push_back({{{0.5, 2.0}, {0.5, 3.0}}, {}});
  return instruction;
}

TEST(PassingConversions, GiveBackIntents) {
  const auto message = to_message(intent(), "map", kStamp);
  EXPECT_EQ(message.header.stamp, kStamp);
  const PassingIntent heard = passing_from_message(message, "map");
  EXPECT_EQ(heard.agent, "ugv1");
  EXPECT_EQ(heard.epoch, 3U);
  EXPECT_EQ(heard.priority, -7);
  EXPECT_TRUE(heard.calls);
  EXPECT_EQ(heard.radius_m, 0.333);
  EXPECT_EQ(heard.goal.value(), Vector2(1.5, -2.25));
  EXPECT_EQ(heard.follows, intent().follows);
  EXPECT_EQ(heard.moves, 4U);
  EXPECT_TRUE(heard.obstacles.empty());
  PassingIntent obstructed = intent();
  obstructed.obstacles = {{1.0, 2.0}, {-3.0, 0.5}};
  EXPECT_EQ(passing_from_message(to_message(obstructed, "map", kStamp), "map").obstacles,
            obstructed.obstacles);
  PassingIntent parked = intent();
  parked.goal.reset();
  EXPECT_FALSE(passing_from_message(to_message(parked, "map", kStamp), "map").goal);
}

TEST(PassingConversions, GiveBackInstructions) {
  const PassingInstruction sent = instruction();
  const PassingInstruction heard = passing_from_message(to_message(sent, "map", kStamp), "map");
  EXPECT_EQ(heard.id, sent.id);
  EXPECT_EQ(heard.id.epoch, 3U);
  EXPECT_EQ(heard.robot, "ugv2");
  EXPECT_EQ(heard.robots, sent.robots);
  EXPECT_EQ(heard.turns, 8U);
  EXPECT_EQ(heard.alone_from, 5U);
  EXPECT_EQ(heard.first, 2U);
  ASSERT_EQ(heard.part.size(), 2U);
  EXPECT_EQ(heard.part[0].path, sent.part[0].path);
  ASSERT_EQ(heard.part[0].after.size(), 2U);
  EXPECT_EQ(heard.part[0].after[1].robot, 2U);
  EXPECT_EQ(heard.part[0].after[1].moves, 1U);
  EXPECT_TRUE(heard.part[1].after.empty());
}

TEST(PassingConversions, RefuseOtherFramesAndWhatNoRobotCanHaveMeant) {
  EXPECT_THROW(passing_from_message(to_message(intent(), "odom", kStamp), "map"),
               std::invalid_argument);
  EXPECT_THROW(passing_from_message(to_message(instruction(), "odom", kStamp), "map"),
               std::invalid_argument);
  auto intent_message = to_message(intent(), "map", kStamp);
  intent_message.goal.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(passing_from_message(intent_message, "map"), std::invalid_argument);
  auto instruction_message = to_message(instruction(), "map", kStamp);
  instruction_message.part[0].after[0].robot = 3;
  EXPECT_THROW(passing_from_message(instruction_message, "map"), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
