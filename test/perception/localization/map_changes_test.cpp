#include "perception/localization/map_changes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "perception/localization/learning_localizer.h"
#include "perception/localization/localisation_scene.h"
#include "perception/room.h"

namespace mocha {
namespace {

constexpr double kLasting_s = 600.0;
const Vector2 kOld(2.5, 0.5);   // where a column stood
const Vector2 kNew(-1.5, 1.0);  // where it stands now

Room room_with(const std::vector<Vector2>& columns) {
  Room room;
  for (const Vector2& column : columns) room.circles.push_back({column, 0.3});
  return room;
}

Pose place(int i) { return {{1.5 * std::cos(0.7 * i), -1.5 + std::sin(0.7 * i)}, 0.4 * i}; }

ScanHits scan_of(const Room& room, const Pose& base, double time_s) {
  ScanHits scan = hits_of(beams_at(room, base, 20.0, 720), base, 0.02);
  scan.time_s = time_s;
  return scan;
}

OccupancyGrid map_of(const Room& room) {
  OccupancyMapOptions options = shipped_map_options();
  options.resolution_m = 0.05;
  OccupancyMap map(options);
  for (int i = 0; i < 40; ++i) map.insert_scan(beams_at(room, place(i), 20.0, 720));
  return map.slice(0.5);
}

/// Cells of that value around a place.
int cells(const OccupancyGrid& map, const Vector2& around, int8_t value) {
  int count = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if ((map.cell_centre(x, y) - around).norm() < 0.4 && map.at(x, y) == value) ++count;
    }
  }
  return count;
}

int walls(const OccupancyGrid& map, const Vector2& around) {
  return cells(map, around, OccupancyGrid::kOccupied);
}

class MapChangesTest : public testing::Test {
 protected:
  /// Scans every ten seconds. Returns how often the map has changed.
  int look(const Room& room, double for_s) {
    int changed = 0;
    for (const double end_s = time_s_ + for_s; time_s_ < end_s; time_s_ += 10.0) {
      const Pose base = place(step_++);
      if (changes_.add(scan_of(room, base, time_s_), base)) ++changed;
    }
    return changed;
  }

  const Room before_ = room_with({kOld, {-2.5, -1.0}});
  const Room after_ = room_with({kNew, {-2.5, -1.0}});
  const OccupancyGrid map_ = map_of(before_);
  MapChanges changes_{map_, kLasting_s};
  double time_s_ = 0.0;
  int step_ = 0;
};

TEST_F(MapChangesTest, LearnsWhatHasGoneAndWhatHasComeForGood) {
  ASSERT_GT(walls(map_, kOld), 10);
  ASSERT_EQ(walls(map_, kNew), 0);
  EXPECT_EQ(look(after_, 0.8 * kLasting_s), 0);
  EXPECT_EQ(changes_.map().cells, map_.cells) << "too early";
  const int changed = look(after_, kLasting_s);
  EXPECT_GE(changed, 1);
  EXPECT_LE(changed, 8);
  EXPECT_EQ(walls(changes_.map(), kOld), 0);
  EXPECT_GT(cells(changes_.map(), kOld, OccupancyGrid::kFree), 100);
  EXPECT_GE(walls(changes_.map(), kNew), 8);
  EXPECT_GT(look(before_, 2.0 * kLasting_s), 0);
  EXPECT_EQ(walls(changes_.map(), kNew), 0) << "and back";
}

TEST_F(MapChangesTest, LearnsNothingWhereNothingHasChanged) {
  for (int i = 0; i < 200; ++i) {
    const Pose off{place(i).position + Vector2(0.02 * std::sin(i), 0.02 * std::cos(3 * i)),
                   place(i).yaw_rad + 0.005 * std::sin(2 * i)};
    changes_.add(scan_of(before_, place(i), 10.0 * i), off);
  }
  int different = 0;
  for (std::size_t i = 0; i < map_.cells.size(); ++i) {
    if (map_.cells[i] != OccupancyGrid::kUnknown && map_.cells[i] != changes_.map().cells[i])
      ++different;
  }
  EXPECT_LE(different, 3);
}

TEST_F(MapChangesTest, WhatStandsSomewhereForAWhileLeavesNoTrace) {
  const Room crowded = room_with({kOld, {-2.5, -1.0}, kNew});
  for (int i = 0; i < 10; ++i) {
    look(crowded, 0.4 * kLasting_s);
    look(before_, 20.0);
  }
  EXPECT_EQ(walls(changes_.map(), kNew), 0);
  EXPECT_GE(walls(changes_.map(), kOld), walls(map_, kOld) - 1);
}

TEST_F(MapChangesTest, ForgetsWhatIsNotLearntYet) {
  look(after_, 0.8 * kLasting_s);
  changes_.forget_doubts();
  time_s_ = 0.0;
  EXPECT_EQ(look(after_, 0.8 * kLasting_s), 0);
}

/// The localiser finds the changed room strange at first, and knows it in the end.
TEST_F(MapChangesTest, ALocaliserThatLearnsExplainsMore) {
  const auto options = shipped_localizer_options(load_robot_model("config", "waveshare_rover"));
  const Room changed = room_with({kNew, {-2.5, -1.0}, {3.5, -2.0}, {0.3, 1.6}, {4.0, 1.5}});
  const auto explained = [&](Localizer& localizer) {
    localizer.expect({place(0), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal()});
    for (int i = 0; i < 400; ++i) {
      const Localization& now = localizer.add(scan_of(changed, place(i), 5.0 * i), place(i));
      EXPECT_LT(distance_m(now.base.pose, place(i)), 0.05) << i;
      if (i == 0) continue;
      EXPECT_EQ(now.state, Localization::State::kLocalized) << i;
    }
    return localizer.localization().quality;
  };
  ScanLocalizer stubborn(options);
  stubborn.set_map(map_);
  LearningLocalizer learning(options, map_, kLasting_s);
  const double by_the_old_map = explained(stubborn);
  EXPECT_LT(by_the_old_map, 0.9);
  EXPECT_GT(explained(learning), by_the_old_map + 0.05);
  EXPECT_GT(learning.changed(), 0);
}

}  // namespace
}  // namespace mocha
