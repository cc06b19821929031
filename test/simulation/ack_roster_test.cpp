#include "simulation/ack_roster.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

using Names = std::vector<std::string>;

TEST(AckRoster, WaitsForEverybody) {
  AckRoster roster;
  EXPECT_TRUE(roster.complete(10));  // no node is expected
  roster.expect("ugv1", "perception");
  roster.expect("ugv2", "perception");
  EXPECT_FALSE(roster.complete(10));
  roster.acknowledge("ugv1", "perception", 10);
  roster.acknowledge("ugv1", "rviz", 10);
  EXPECT_FALSE(roster.complete(10));
  roster.acknowledge("ugv2", "perception", 10);
  EXPECT_TRUE(roster.complete(10));
  EXPECT_FALSE(roster.complete(20));
}

TEST(AckRoster, ANodeThatWasGivenUpCountsAgainOnceItIsBack) {
  AckRoster roster;
  roster.expect("ugv1", "perception");
  roster.expect("ugv1", "planner");
  roster.acknowledge("ugv1", "planner", 10);
  EXPECT_EQ(roster.give_up(10), Names{"ugv1/perception"});
  EXPECT_EQ(roster.missing(), Names{"ugv1/perception"});
  EXPECT_TRUE(roster.complete(10));
  EXPECT_TRUE(roster.give_up(10).empty());  // reported once
  roster.acknowledge("ugv1", "planner", 20);
  EXPECT_TRUE(roster.complete(20));
  roster.acknowledge("ugv1", "perception", 20);
  EXPECT_TRUE(roster.missing().empty());
  roster.acknowledge("ugv1", "planner", 30);
  EXPECT_FALSE(roster.complete(30));
}

}  // namespace
}  // namespace mocha
