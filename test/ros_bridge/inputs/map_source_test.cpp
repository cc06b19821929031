#include "ros_bridge/inputs/map_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

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

map_msgs::OccupancyGridUpdate message(const GridUpdate& cells, double stamp_s, std::uint32_t number,
                                      const std::string& frame = "map") {
  map_msgs::OccupancyGridUpdate update;
  update.header.seq = number;
  update.header.stamp = ros::Time(stamp_s);
  update.header.frame_id = frame;
  to_message(cells, update);
  return update;
}

struct MapInputTest : ::testing::Test {
  MapInputTest() {
    ros::Time::init();  // warnings are throttled
    fill_disc(grid, {2.0, 2.0}, 0.5, OccupancyGrid::kOccupied);
  }

  /// A map, and the first update: one that asks for a map to begin with.
  void begin() {
    maps.on_map(message(grid, 10.0));
    maps.on_update(message(kNothing, 10.0, 7));
    maps.on_map(message(grid, 10.0));
    ASSERT_EQ(asked, 1);
  }

  bool is_occupied(int x, int y) { return maps.newest().at(x, y) == OccupancyGrid::kOccupied; }

  const GridUpdate kNothing{0, 0, 0, 0, {}};
  const GridUpdate kHit{5, 6, 2, 1, {100, 100}};
  const GridUpdate kMiss{5, 6, 1, 1, {0}};
  int asked = 0;
  MapInput maps{"map", [this] { ++asked; }};
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

TEST_F(MapInputTest, UpdatesChangeTheMapAndMakeItNewer) {
  begin();
  maps.on_update(message(kHit, 11.0, 8));
  EXPECT_TRUE(is_occupied(5, 6));
  EXPECT_TRUE(is_occupied(6, 6));
  EXPECT_NEAR(maps.age_s(ros::Time(11.5)), 0.5, 1e-9);
  maps.on_update(message(kMiss, 12.0, 9));
  EXPECT_FALSE(is_occupied(5, 6));
  EXPECT_TRUE(is_occupied(6, 6));
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(maps.refused(), 0);
}

TEST_F(MapInputTest, TheFirstUpdateCountsAtOnceThoughAGridIsAskedFor) {
  maps.on_map(message(grid, 10.0));
  maps.on_update(message(kHit, 12.0, 7));
  EXPECT_EQ(asked, 1);
  EXPECT_TRUE(is_occupied(5, 6));
  fill_box(grid, {3.0, 3.0}, {3.2, 3.2});
  maps.on_map(message(grid, 11.0));  // with what was changed by an update that did not come
  EXPECT_TRUE(is_occupied(5, 6));
  EXPECT_TRUE(is_occupied(61, 61));
  EXPECT_NEAR(maps.age_s(ros::Time(12.0)), 0.0, 1e-9);
}

TEST_F(MapInputTest, AGridContainsUpdatesThatComeAfterIt) {
  begin();
  maps.on_map(message(grid, 12.0));
  maps.on_update(message(kHit, 11.0, 8));
  maps.on_update(message(kHit, 12.0, 9));
  EXPECT_FALSE(is_occupied(5, 6));
  maps.on_update(message(kHit, 13.0, 10));
  EXPECT_TRUE(is_occupied(5, 6));
}

TEST_F(MapInputTest, UpdatesOfAnAnnouncedGridWaitForIt) {
  begin();
  maps.on_update(message(kNothing, 11.0, 8));
  maps.on_update(message(kHit, 12.0, 9));  // would fit the former grid, but elsewhere
  EXPECT_FALSE(is_occupied(5, 6));
  EXPECT_NEAR(maps.age_s(ros::Time(12.0)), 2.0, 1e-9);
  maps.on_map(message(grid, 10.5));  // not yet
  EXPECT_FALSE(is_occupied(5, 6));
  maps.on_map(message(grown_to_hold(grid, {{-1.0, 0.0}}, 0.0), 11.0));
  EXPECT_EQ(maps.newest().width, grid.width + 20);
  EXPECT_TRUE(is_occupied(5, 6));
  EXPECT_NEAR(maps.age_s(ros::Time(12.0)), 0.0, 1e-9);
  EXPECT_EQ(asked, 1);
}

TEST_F(MapInputTest, AGridIsAskedForWhereAnUpdateIsMissing) {
  begin();
  maps.on_update(message(kHit, 12.0, 9));
  EXPECT_EQ(asked, 2);
  EXPECT_NEAR(maps.age_s(ros::Time(12.0)), 2.0, 1e-9) << "it is not newer than what it has";
  fill_box(grid, {3.0, 3.0}, {3.2, 3.2});
  maps.on_map(message(grid, 11.0));  // as it was when it was asked for
  EXPECT_TRUE(is_occupied(5, 6));
  EXPECT_TRUE(is_occupied(61, 61));
  EXPECT_NEAR(maps.age_s(ros::Time(12.0)), 0.0, 1e-9);
}

TEST_F(MapInputTest, AGridIsAskedForWhereTheClockWasSetBack) {
  begin();
  maps.on_update(message(kNothing, 3.0, 8));
  maps.on_update(message(kHit, 3.5, 9));
  EXPECT_EQ(asked, 2);
  maps.on_map(message(grid, 3.0));
  EXPECT_TRUE(is_occupied(5, 6));
  EXPECT_NEAR(maps.age_s(ros::Time(4.0)), 0.5, 1e-9);
}

TEST_F(MapInputTest, RefusedUpdatesAreCountedAndTheMapIsAskedFor) {
  begin();
  maps.on_update(message(kHit, 11.0, 8, "odom"));
  EXPECT_EQ(maps.refused(), 1);
  EXPECT_EQ(asked, 1) << "it was of another map";
  std::uint32_t number = 9;
  for (const auto& [x, width] : {std::pair(-1, 1u), {grid.width, 1u}, {0, 2u}, {0, 0xffffffffu}}) {
    map_msgs::OccupancyGridUpdate broken = message(kMiss, 11.0 + number, number);
    ++number;
    broken.x = x;
    broken.width = width;
    maps.on_update(broken);
    maps.on_map(message(grid, 10.0));
  }
  EXPECT_EQ(maps.refused(), 5);
  EXPECT_EQ(asked, 5);
  EXPECT_EQ(maps.newest().cells, grid.cells);
}

}  // namespace
}  // namespace mocha
