#include "ros_bridge/runtime/memory_file.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace mocha {
namespace {

TEST(MemoryFile, IsWhereTheParameterSays) {
  EXPECT_EQ(memory_file("/data/ugv1.count", "ugv1", ".epoch"), "/data/ugv1.count");
}

TEST(MemoryFile, IsElseInRosHome) {
  ASSERT_EQ(setenv("ROS_HOME", "/var/ros", 1), 0);
  EXPECT_EQ(memory_file("", "ugv1", ".epoch"), "/var/ros/mocha_ugv/ugv1.epoch");
  ASSERT_EQ(unsetenv("ROS_HOME"), 0);
  ASSERT_EQ(setenv("HOME", "/home/pi", 1), 0);
  EXPECT_EQ(memory_file("", "ugv1", ".epoch"), "/home/pi/.ros/mocha_ugv/ugv1.epoch");
}

TEST(MemoryFile, OthersAreBesideIt) {
  EXPECT_EQ(beside("/data/ugv1.epoch", ".stops"), "/data/ugv1.stops");
}

}  // namespace
}  // namespace mocha
