#include "ros_bridge/rviz/passing_drawing.h"

#include <gtest/gtest.h>

#include <string>

namespace mocha {
namespace {

using visualization_msgs::Marker;

const std::vector<std::string> kRobots = {"ugv1", "ugv2"};

/// Four turns of ugv1 along the x axis; the third has to wait for ugv2.
PassingInstruction instruction(std::uint32_t number) {
  PassingInstruction instruction;
  instruction.id = {"ugv2", 1, number};
  instruction.robot = "ugv1";
  instruction.robots = kRobots;
  instruction.turns = 4;
  for (int i = 0; i < 4; ++i) instruction.part.push_back({{{1.0 * i, 0.0}, {i + 1.0, 0.0}}, {}});
  instruction.part[2].after = {{1, 2}};
  return instruction;
}

PassingIntent intent(const std::string& agent, std::uint32_t number, std::uint32_t moves) {
  PassingIntent intent;
  intent.agent = agent;
  intent.follows = {"ugv2", 0, number};
  intent.moves = moves;
  return intent;
}

std::vector<Marker> drawn(const PassingDrawing& passing, const std::string& name) {
  Drawing drawing("map", ros::Time(1.0));
  passing.draw(drawing);
  std::vector<Marker> found;
  for (const Marker& marker : drawing.markers().markers) {
    if (marker.ns == name) found.push_back(marker);
  }
  return found;
}

/// From where to where, and whether broad ("=") or thin ("-").
std::string told(const PassingDrawing& passing) {
  std::string text;
  for (const Marker& turn : drawn(passing, "turns")) {
    text += std::to_string(static_cast<int>(turn.points.front().x));
    text += turn.scale.x > 0.1 ? "=" : "-";
  }
  return text;
}

TEST(PassingDrawing, TurnsThatMayBeMadeAreBroadAndThoseThatHaveToWaitAreThin) {
  PassingDrawing passing("ugv1");
  passing.note(instruction(7));
  EXPECT_EQ(told(passing), "");  // it does not keep to the order yet
  passing.note(intent("ugv1", 7, 0));
  EXPECT_EQ(told(passing), "0=1=2-3-");
  passing.note(intent("ugv2", 7, 1));
  EXPECT_EQ(told(passing), "0=1=2-3-");
  passing.note(intent("ugv2", 7, 2));
  EXPECT_EQ(told(passing), "0=1=2=3=");
  passing.note(intent("ugv1", 7, 3));
  EXPECT_EQ(told(passing), "2=3=");
}

TEST(PassingDrawing, TheObstaclesThatTheRobotItselfTellsOfAreDrawn) {
  PassingDrawing passing("ugv1");
  PassingIntent obstructed = intent("ugv2", 7, 0);
  obstructed.obstacles = {{1.0, 2.0}, {3.0, 4.0}};
  passing.note(obstructed);
  EXPECT_TRUE(drawn(passing, "obstacles").empty());
  obstructed.agent = "ugv1";
  passing.note(obstructed);
  EXPECT_EQ(drawn(passing, "obstacles").size(), 2u);
  passing.note(intent("ugv1", 7, 0));
  EXPECT_TRUE(drawn(passing, "obstacles").empty());
}

TEST(PassingDrawing, OnlyWhatTheRobotKeepsToIsDrawn) {
  PassingDrawing passing("ugv1");
  PassingInstruction others = instruction(7);
  others.robot = "ugv2";
  passing.note(others);
  passing.note(intent("ugv1", 7, 0));
  EXPECT_EQ(told(passing), "");
  passing.note(instruction(7));
  passing.note(intent("ugv1", 7, 1));
  passing.note(instruction(8));  // another one, not taken up
  passing.note(intent("ugv2", 8, 4));
  EXPECT_EQ(told(passing), "0=1=2-3-");
  passing.note(intent("ugv1", 8, 0));
  passing.note(intent("ugv2", 8, 4));
  EXPECT_EQ(told(passing), "0=1=2=3=");
  passing.note(intent("ugv1", 0, 0));
  EXPECT_EQ(told(passing), "");
}

TEST(PassingDrawing, FurtherPartsAreAddedButForOnesOfAnotherGroup) {
  PassingDrawing passing("ugv1");
  PassingInstruction begin = instruction(7);
  begin.part.resize(2);
  PassingInstruction rest = instruction(7);
  rest.first = 2;
  rest.part.erase(rest.part.begin(), rest.part.begin() + 2);
  passing.note(begin);
  passing.note(intent("ugv1", 7, 0));
  EXPECT_EQ(told(passing), "0=1=");
  PassingInstruction odd = rest;
  odd.robots = {"ugv1", "ugv2", "ugv3"};
  odd.part[0].after = {{2, 1}};
  passing.note(odd);
  EXPECT_EQ(told(passing), "0=1=");
  passing.note(rest);
  EXPECT_EQ(told(passing), "0=1=2-3-");
}

}  // namespace
}  // namespace mocha
