#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "perception/sensor/range_smoothing.h"
#include "perception/shipped_options.h"
#include "ros_bridge/messages/sensor_conversions.h"

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

/// Calls take(beams, time) with each scan of the bag.
template <class Take>
void replay(Take take) {
  rosbag::Bag bag(bag_path());
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    const auto scan = message.instantiate<sensor_msgs::LaserScan>();
    ASSERT_TRUE(scan);
    const PlanarScan planar = from_message(*scan);
    ASSERT_EQ(fault_of(planar), "");
    const Eigen::Isometry3d pose = mount_of(scan->header.frame_id);
    auto beams = to_beams(smoothed(planar, shipped_smoothing_m()), {pose, pose}, {30.0, 10.0});
    take(beams, planar.end_time_s());
  }
}

void check_corridor(const OccupancyMap& map) {
  const OccupancyGrid grid = map.slice(0.0);
  // The long wall: 6.9 m of it, straight within 25 cm.
  const double columns = 6.9 / grid.resolution_m;
  const int wall = count(grid, {-3.0, -3.05}, {3.9, -2.65}, OccupancyGrid::kOccupied);
  EXPECT_GT(wall, 0.8 * columns);
  EXPECT_LT(wall, 1.88 * columns);
  EXPECT_EQ(count(grid, {-1.5, -2.5}, {1.5, -1.0}, OccupancyGrid::kOccupied), 0)
      << "people have left no trace";
  const double cells = 3.0 * 1.5 / (grid.resolution_m * grid.resolution_m);
  EXPECT_GT(count(grid, {-1.5, -2.5}, {1.5, -1.0}, OccupancyGrid::kFree), 0.945 * cells);
  EXPECT_EQ(count(grid, {-3.0, -9.0}, {3.9, -3.3}, OccupancyGrid::kFree), 0)
      << "nothing is seen through the wall";
}

TEST(LidarBag, RealScansGiveACorridorWithoutThePeopleInIt) {
  if (!std::filesystem::exists(bag_path())) GTEST_SKIP() << "no " << bag_path();
  OccupancyMap map(shipped_map_options());
  int scans = 0;
  replay([&](std::vector<Beam>& beams, double) {
    map.insert_scan(beams);
    ++scans;
  });
  EXPECT_EQ(scans, 661);
  check_corridor(map);
}

/// What became of one track.
struct Followed {
  double begin_s;
  double end_s;
  Vector2 from;
  Vector2 at;
  double farthest_m = 0.0;
  double path_m = 0.0;
  double fastest_mps = 0.0;

  void note(const TrackedObstacle& thing) {
    end_s = thing.time_s;
    path_m += (thing.position - at).norm();
    at = thing.position;
    farthest_m = std::max(farthest_m, (at - from).norm());
    fastest_mps = std::max(fastest_mps, thing.velocity.norm());
  }
  double length_s() const { return end_s - begin_s; }
};

TEST(LidarBag, WhoWalksIsFollowed) {
  if (!std::filesystem::exists(bag_path())) GTEST_SKIP() << "no " << bag_path();
  OccupancyMap map(shipped_map_options());
  MovingObjectFilter filter(shipped_sorter_options());
  std::map<std::uint32_t, Followed> tracks;
  int hits = 0;
  int astray = 0;  // of the hits on moving things, those on no track
  replay([&](std::vector<Beam>& beams, double time_s) {
    filter.sort(beams, map);
    map.insert_scan(beams);
    const auto moving = filter.moving(time_s);
    for (const TrackedObstacle& thing : filter.things(time_s)) {
      if (!thing.is_mover) continue;
      const Followed fresh{time_s, time_s, thing.position, thing.position};
      tracks.insert({thing.id, fresh}).first->second.note(thing);
    }
    for (const Beam& beam : beams) {
      if (beam.kind != BeamEnd::kIgnored) continue;
      ++hits;
      astray += std::none_of(moving.begin(), moving.end(), [&](const TrackedObstacle& thing) {
        return (thing.position - beam.end.head<2>()).norm() < thing.radius_m + 0.15;
      });
    }
  });
  check_corridor(map);
  // From 6.6 s on one person walks about, now and then stopping, until the end at 33 s; another one
  // sits and moves his feet.
  EXPECT_EQ(tracks.size(), 2u) << "one number a person";
  EXPECT_GT(hits, 3000);
  EXPECT_LT(astray, 0.05 * hits);
  const auto nearer = [](const auto& a, const auto& b) {
    return a.second.farthest_m < b.second.farthest_m;
  };
  const auto shorter = [](const auto& a, const auto& b) {
    return a.second.length_s() < b.second.length_s();
  };
  ASSERT_FALSE(tracks.empty());
  const Followed& sits = std::max_element(tracks.begin(), tracks.end(), shorter)->second;
  EXPECT_GT(sits.length_s(), 30.0) << "one number all the time";
  EXPECT_LT(sits.farthest_m, 0.3);
  const Followed& longest = std::max_element(tracks.begin(), tracks.end(), nearer)->second;
  EXPECT_GT(longest.length_s(), 26.0) << "one number as long as the person is there";
  EXPECT_GT(longest.farthest_m, 1.5);
  EXPECT_GT(longest.path_m / longest.length_s(), 0.3) << "m/s on average";
  EXPECT_LT(longest.path_m / longest.length_s(), 1.2);
  for (const auto& [id, track] : tracks) EXPECT_LT(track.fastest_mps, 2.0) << id;
}

TEST(LidarBag, ALidarFindsItsPlaceAmongPeople) {
  if (!std::filesystem::exists(bag_path())) GTEST_SKIP() << "no " << bag_path();
  OccupancyMap map(shipped_map_options());
  replay([&](std::vector<Beam>& beams, double) { map.insert_scan(beams); });
  ScanLocalizer localizer(shipped_localizer_options());
  localizer.set_map(map.slice(0.5));
  const Pose base{{0.0, 0.0}, 0.0};  // where the front lidar stands
  std::vector<double> off_m;
  double begun_s = 0.0;
  double found_s = 0.0;
  replay([&](std::vector<Beam>& beams, double time_s) {
    if (beams.empty() || beams[0].origin.norm() > 0.1) return;  // the other lidar
    if (begun_s == 0.0) begun_s = time_s;
    ScanHits scan = hits_of(beams, base, 0.05);
    scan.time_s = time_s;
    const Localization& now = localizer.add(scan, base);
    if (now.state != Localization::State::kLocalized) return;
    if (off_m.empty()) found_s = time_s;
    off_m.push_back(now.base.pose.position.norm());
    EXPECT_LT(std::abs(now.base.pose.yaw_rad), 0.02) << time_s;
  });
  ASSERT_GT(off_m.size(), 290u);  // of 331
  EXPECT_LT(found_s - begun_s, 3.0);
  std::sort(off_m.begin(), off_m.end());
  EXPECT_LT(off_m[off_m.size() / 2], 0.03);
  EXPECT_LT(off_m.back(), 0.1);
  RecordProperty("median_mm", static_cast<int>(1e3 * off_m[off_m.size() / 2]));
  RecordProperty("worst_mm", static_cast<int>(1e3 * off_m.back()));
}

}  // namespace
}  // namespace mocha
