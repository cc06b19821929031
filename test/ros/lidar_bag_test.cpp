#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "perception/occupancy_map.h"
#include "ros/sensor_conversions.h"

namespace mocha {
namespace {

std::string bag_path() {
  const char* data = std::getenv("MOCHA_DATA");
  return std::string(data != nullptr ? data : "../shared/data") +
         "/bags/obstacle_detector_scans_demo.bag";
}

/// The lidars stand back to back in a corridor, and people walk about; found by matching what both
/// see.
Eigen::Isometry3d mount_of(const std::string& frame) {
  if (frame == "front_scanner") return Eigen::Isometry3d::Identity();
  return Eigen::Translation3d(-0.38, -0.033, 0.0) *
         Eigen::AngleAxisd(3.163, Eigen::Vector3d::UnitZ());
}

int count(const OccupancyGrid& grid, const Vector2& low, const Vector2& high, int8_t value) {
  int cells = 0;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Vector2 centre = grid.cell_centre(x, y);
      const bool inside =
          (centre.array() > low.array()).all() && (centre.array() < high.array()).all();
      if (inside && grid.at(x, y) == value) ++cells;
    }
  }
  return cells;
}

TEST(LidarBag, RealScansGiveACorridorWithoutThePeopleInIt) {
  if (!std::filesystem::exists(bag_path())) GTEST_SKIP() << "no " << bag_path();
  OccupancyMap map({});
  rosbag::Bag bag(bag_path());
  int scans = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    const auto scan = message.instantiate<sensor_msgs::LaserScan>();
    ASSERT_TRUE(scan);
    const PlanarScan planar = from_message(*scan);
    ASSERT_EQ(fault_of(planar), "");
    const Eigen::Isometry3d pose = mount_of(scan->header.frame_id);
    map.insert_scan(to_beams(planar, {pose, pose}, {30.0, 10.0}));
    ++scans;
  }
  EXPECT_EQ(scans, 661);
  const OccupancyGrid grid = map.slice(0.0);
  // The long wall: 7 m of it at 5 cm cells, straight within 25 cm.
  const int wall = count(grid, {-3.0, -3.05}, {3.9, -2.65}, OccupancyGrid::kOccupied);
  EXPECT_GT(wall, 110);
  EXPECT_LT(wall, 260);
  EXPECT_EQ(count(grid, {-1.5, -2.5}, {1.5, -1.0}, OccupancyGrid::kOccupied), 0)
      << "people have left no trace";
  EXPECT_GT(count(grid, {-1.5, -2.5}, {1.5, -1.0}, OccupancyGrid::kFree), 1700) << "of 1800";
  EXPECT_EQ(count(grid, {-3.0, -9.0}, {3.9, -3.3}, OccupancyGrid::kFree), 0)
      << "nothing is seen through the wall";
}

}  // namespace
}  // namespace mocha
