#include "perception/mapping/keep_out.h"

#include <gtest/gtest.h>

#include "perception/shipped_options.h"

namespace mocha {
namespace {

constexpr double kHalf_m = 2.0;

std::vector<Polygon> square_about(const Vector2& centre) {
  const double h = kHalf_m;
  return {Polygon{{centre + Vector2(-h, -h), centre + Vector2(h, -h), centre + Vector2(h, h),
                   centre + Vector2(-h, h)}}};
}

struct KeepOutTest : ::testing::Test {
  void see_wall(const Vector2& from, const Vector2& to) {
    std::vector<Beam> beams;
    for (int i = 0; i <= 200; ++i) {
      const Vector2 end = from + (to - from) * i / 200.0;
      beams.push_back(
          {{end.x() - 0.01, end.y(), 0.2}, {end.x(), end.y(), 0.2}, BeamEnd::kHit, 0.0});
    }
    for (int i = 0; i < 5; ++i) map.insert_scan(beams);
  }
  void look(const Vector2& place) { keep_out.look({{place, 0.0}}, map); }
  double open_m(const Vector2& place) const {
    return gap(place, keep_out.areas().front()).distance_m;
  }

  OccupancyMap map{shipped_map_options()};
  KeepOut keep_out{shipped_robot()};
};

TEST_F(KeepOutTest, NothingIsOpenForARobotOutside) {
  keep_out.set(square_about({0.0, 0.0}));
  look({5.0, 0.0});
  EXPECT_TRUE(keep_out.open().path.empty());
  look({kHalf_m + 0.5, 0.0});  // beside it
  EXPECT_TRUE(keep_out.open().path.empty());
}

TEST_F(KeepOutTest, TheShortestWayOutIsOpenUntilTheRobotHasLeft) {
  keep_out.set(square_about({0.0, 0.0}));
  look({1.0, 0.3});
  const Strip open = keep_out.open();
  ASSERT_TRUE(keep_out.leads_out());
  EXPECT_EQ(open.path.front(), Vector2(1.0, 0.3));
  EXPECT_GE(open_m(open.path.back()), open.half_width_m);
  EXPECT_NEAR(open.path.back().y(), 0.3, 0.3);
  EXPECT_GT(open.path.back().x(), kHalf_m);
  EXPECT_GT(open.half_width_m, shipped_robot().footprint.circumscribed_radius_m());
  EXPECT_FALSE(open.covers({-1.0, 0.3}));
  EXPECT_FALSE(open.covers({1.0, 1.5}));
  const int version = keep_out.version();
  look({1.8, 0.3});
  EXPECT_EQ(keep_out.version(), version);
  EXPECT_EQ(keep_out.open().path, open.path);
  look({kHalf_m + 0.6, 0.3});
  EXPECT_TRUE(keep_out.open().path.empty());
  look({kHalf_m + 0.4, 0.3});  // not again
  EXPECT_TRUE(keep_out.open().path.empty());
}

TEST_F(KeepOutTest, WhatTheRobotTakesToStopIsOpen) {
  keep_out.set(square_about({3.0, 0.0}));
  std::vector<Pose> course;
  for (double x = 0.0; x < 1.5; x += 0.1) course.push_back({{x, 0.0}, 0.0});
  keep_out.look(course, map);
  ASSERT_TRUE(keep_out.leads_out());
  EXPECT_TRUE(keep_out.open().covers({1.45, 0.0}));
  EXPECT_FALSE(keep_out.open().covers({2.5, 0.0}));
  // The same course later, when the areas were known before, opens nothing.
  keep_out.set(square_about({3.0, 0.0}));
  look({0.0, 0.0});
  keep_out.look(course, map);
  EXPECT_TRUE(keep_out.open().path.empty());
}

TEST_F(KeepOutTest, TheWayOutLeadsRoundWalls) {
  see_wall({1.8, -3.0}, {1.8, 3.0});
  keep_out.set(square_about({0.0, 0.0}));
  look({1.0, 0.0});
  ASSERT_TRUE(keep_out.leads_out());
  const Vector2 end = keep_out.open().path.back();
  EXPECT_LT(end.x(), 1.8);
  for (const Vector2& place : keep_out.open().path)
    EXPECT_FALSE(map.is_occupied_within(place, 0.1, false));
}

TEST_F(KeepOutTest, WithoutAWayOutTheRobotsPlaceIsOpenAndSearchingGoesOn) {
  for (const double side : {-1.0, 1.0}) {
    see_wall({side, -1.0}, {side, 1.0});
    see_wall({-1.0, side}, {1.0, side});
  }
  keep_out.set(square_about({0.0, 0.0}));
  look({0.0, 0.0});
  EXPECT_FALSE(keep_out.leads_out());
  EXPECT_TRUE(keep_out.open().covers({0.0, 0.0}));
  map.clear_disc({1.0, 0.0}, 0.8);
  look({0.0, 0.0});
  EXPECT_TRUE(keep_out.leads_out());
}

TEST_F(KeepOutTest, AWayThatIsBlockedIsReplaced) {
  keep_out.set(square_about({0.0, 0.0}));
  look({1.0, 0.0});
  ASSERT_GT(keep_out.open().path.back().x(), kHalf_m);
  see_wall({1.8, -3.0}, {1.8, 3.0});
  look({1.0, 0.0});
  ASSERT_TRUE(keep_out.leads_out());
  EXPECT_LT(keep_out.open().path.back().x(), 1.8);
}

}  // namespace
}  // namespace mocha
