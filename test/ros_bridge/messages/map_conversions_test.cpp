#include "ros_bridge/messages/map_conversions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "ros_bridge/messages/conversions.h"

namespace mocha {
namespace {

nav_msgs::OccupancyGrid map_message() {
  nav_msgs::OccupancyGrid map;
  map.info.resolution = 0.05f;
  map.info.width = 3;
  map.info.height = 2;
  map.info.origin = to_message(Pose{{-1.0, 2.0}, 0.0});
  map.data = {0, 25, 26, 64, 65, -1};
  return map;
}

TEST(MapConversions, MapsAreReadByTheirThresholds) {
  const OccupancyGrid grid = from_message(map_message());
  EXPECT_EQ(grid.width, 3);
  EXPECT_EQ(grid.height, 2);
  EXPECT_NEAR(grid.resolution_m, 0.05, 1e-8);
  EXPECT_EQ(grid.origin, Vector2(-1.0, 2.0));
  using G = OccupancyGrid;
  EXPECT_EQ(grid.cells, (std::vector<int8_t>{G::kFree, G::kFree, G::kUnknown, G::kUnknown,
                                             G::kOccupied, G::kUnknown}));
}

TEST(MapConversions, MalformedMapsAreRefused) {
  using Message = nav_msgs::OccupancyGrid;
  const auto refuses = [&](const char* what, const std::function<void(Message&)>& spoil) {
    Message message = map_message();
    spoil(message);
    EXPECT_THROW(from_message(message), std::invalid_argument) << what;
  };
  refuses("no cells", [](Message& m) {
    m.info.width = 0;
    m.data.clear();
  });
  refuses("too few cells", [](Message& m) { m.data.pop_back(); });
  refuses("too many cells", [](Message& m) { m.data.push_back(0); });
  refuses("huge", [](Message& m) {
    m.info.width = 4000000000u;
    m.info.height = 4000000000u;
  });
  refuses("no resolution", [](Message& m) { m.info.resolution = 0.0f; });
  refuses("negative resolution", [](Message& m) { m.info.resolution = -0.05f; });
  refuses("resolution not finite", [](Message& m) { m.info.resolution = NAN; });
  refuses("resolution infinite", [](Message& m) { m.info.resolution = INFINITY; });
  refuses("origin not finite", [](Message& m) { m.info.origin.position.y = NAN; });
  refuses("rotated", [](Message& m) { m.info.origin.orientation = quaternion_of(0.1); });
  refuses("no orientation at all", [](Message& m) { m.info.origin.orientation.w = NAN; });
}

TEST(MapConversions, UpdatesAreReadAsTheyAreWritten) {
  const GridUpdate cells{4, 5, 3, 2, {0, 100, -1, 0, 0, 100}};
  map_msgs::OccupancyGridUpdate message;
  to_message(cells, message);
  const GridUpdate read = from_message(message);
  EXPECT_EQ(read.x, 4);
  EXPECT_EQ(read.y, 5);
  EXPECT_EQ(read.width, 3);
  EXPECT_EQ(read.height, 2);
  EXPECT_EQ(read.cells, cells.cells);
  message.data = {25, 65, 50, 1, 2, 99};
  EXPECT_EQ(from_message(message).cells, cells.cells) << "thresholds are those of whole maps";
}

TEST(MapConversions, MalformedUpdatesAreRefused) {
  map_msgs::OccupancyGridUpdate message;
  to_message(GridUpdate{0, 0, 2, 2, {0, 0, 0, 0}}, message);
  message.data.pop_back();
  EXPECT_THROW(from_message(message), std::invalid_argument);
  message.width = message.height = 0x80000000u;
  EXPECT_THROW(from_message(message), std::invalid_argument);
  message.width = 0xffffffffu;
  message.height = 0;
  message.data.clear();
  EXPECT_THROW(from_message(message), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
