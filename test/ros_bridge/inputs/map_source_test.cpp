#include "ros_bridge/inputs/map_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ros_bridge/messages/map_conversions.h"
#include "topology/grid_world.h"

namespace mocha {
namespace {

using Solid = DistanceField::Solid;

nav_msgs::OccupancyGrid message(const OccupancyGrid& grid, double stamp_s,
                                const std::string& frame = "map") {
  nav_msgs::OccupancyGrid map;
  map.header.stamp = ros::Time(stamp_s);
  map.header.frame_id = frame;
  map.info.origin.orientation.w = 1.0;
  to_message(grid, map);
  return map;
}

struct MapInputTest : ::testing::Test {
  MapInputTest() {
    ros::Time::init();  // warnings are throttled
    fill_disc(grid, {2.0, 2.0}, 0.5, OccupancyGrid::kOccupied);
  }

  MapInput maps{"map"};
  OccupancyGrid grid = free_grid({0.0, 0.0}, {6.0, 4.0});
};

TEST_F(MapInputTest, HasNothingAtFirst) {
  EXPECT_FALSE(maps.available());
  EXPECT_EQ(maps.age_s(ros::Time(100.0)), std::numeric_limits<double>::infinity());
}

TEST_F(MapInputTest, KnowsAgeAndDistances) {
  maps.on_map(message(grid, 10.0));
  ASSERT_TRUE(maps.available());
  EXPECT_NEAR(maps.age_s(ros::Time(11.5)), 1.5, 1e-9);
  const auto field = maps.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0);
  EXPECT_NEAR(field->distance_bound({3.0, 2.0}), 0.5, 0.05);
}

TEST_F(MapInputTest, AMapInWhichNothingChangedOnlyMakesItNewer) {
  maps.on_map(message(grid, 10.0));
  const auto first = maps.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0);
  maps.on_map(message(grid, 11.0));
  EXPECT_EQ(maps.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0), first);
  EXPECT_NEAR(maps.age_s(ros::Time(11.5)), 0.5, 1e-9);
  grid.origin.x() += grid.resolution_m;
  maps.on_map(message(grid, 12.0));
  EXPECT_NE(maps.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0), first);
}

TEST_F(MapInputTest, RefusedMapsAreCountedAndLeaveTheFormerOne) {
  maps.on_map(message(grid, 10.0));
  const auto before = maps.field(Solid::kOccupied, {}, 0.0);
  maps.on_map(message(grid, 11.0, "odom"));
  nav_msgs::OccupancyGrid broken = message(grid, 11.0);
  broken.data.pop_back();
  maps.on_map(broken);
  broken = message(grid, 11.0);
  broken.info.resolution = NAN;
  maps.on_map(broken);
  EXPECT_EQ(maps.refused(), 3);
  EXPECT_EQ(maps.field(Solid::kOccupied, {}, 0.0), before);
  EXPECT_NEAR(maps.age_s(ros::Time(12.0)), 2.0, 1e-9);
}

}  // namespace
}  // namespace mocha
