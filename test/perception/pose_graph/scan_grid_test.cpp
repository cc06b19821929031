#include "perception/pose_graph/scan_grid.h"

#include <gtest/gtest.h>

#include "perception/room.h"

namespace mocha {
namespace {

/// Keyframes along a room, in which somebody walks ahead of the robot.
class ScanGridTest : public testing::Test {
 protected:
  static constexpr int kKeyframes = 8;

  ScanGridTest() : keyframes_(kKeyframes) {
    Room room;
    room.circles = {{{0.5, 1.0}, 0.3}, {{0.0, 0.0}, 0.25}};
    for (int i = 0; i < kKeyframes; ++i) {
      const Pose pose{{-3.0 + 0.5 * i, -1.0}, 0.0};
      room.circles[1].centre = person(i);
      keyframes_[i].scan = hits_of(beams_at(room, pose, 20.0, 720), pose, 0.02);
      placed_.push_back({i, pose, &keyframes_[i]});
    }
    grid_ = grid_of(placed_, Vector2::Zero(), 100.0, 0.05);
  }

  static Vector2 person(int i) { return {-1.8 + 0.5 * i, -0.8}; }

  int8_t cell(const Vector2& place) const {
    const Vector2 at = (place - grid_.origin) / grid_.resolution_m;
    return grid_.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
  }

  std::vector<ScanKeyframe> keyframes_;
  std::vector<PlacedKeyframe> placed_;
  OccupancyGrid grid_;
};

TEST_F(ScanGridTest, HoldsWhatStandsForGood) {
  EXPECT_EQ(cell({-1.0, -2.0}), OccupancyGrid::kFree);
  EXPECT_EQ(cell({-4.03, 0.0}), OccupancyGrid::kOccupied);
  EXPECT_EQ(cell({0.5, 0.7}), OccupancyGrid::kOccupied);
  EXPECT_EQ(cell(person(2)), OccupancyGrid::kFree);
}

TEST_F(ScanGridTest, BeamsThatMetSomebodyWhoWentOnSayNothingOfTheirEnds) {
  for (int i = 1; i < kKeyframes - 2; ++i) {
    int met = 0;
    int ignored = 0;
    int wrongly_ignored = 0;
    for (const Beam& beam : lasting_beams(placed_[i], grid_)) {
      const bool is_person = (beam.end.head<2>() - person(i)).norm() < 0.27;
      if (is_person) ++met;
      if (beam.kind == BeamEnd::kIgnored) ++(is_person ? ignored : wrongly_ignored);
    }
    EXPECT_GT(met, 10) << i;
    EXPECT_GE(ignored, 0.9 * met) << i;
    EXPECT_EQ(wrongly_ignored, 0) << i;
  }
}

}  // namespace
}  // namespace mocha
