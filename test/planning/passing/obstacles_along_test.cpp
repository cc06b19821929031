#include "planning/passing/obstacles_along.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kClearance_m = 0.4;

/// Two pillars of 0.4 m, at (0, 0) and (3, 0).
std::shared_ptr<const StaticMap> two_pillars() {
  OccupancyGrid grid = free_grid({-5.0, -5.0}, {8.0, 5.0});
  fill_box(grid, {-0.2, -0.2}, {0.2, 0.2});
  fill_box(grid, {2.8, -0.2}, {3.2, 0.2});
  return static_map_of(grid);
}

std::vector<Vector2> along(const std::vector<Vector2>& path) {
  return obstacles_along(path, *two_pillars(), kClearance_m);
}

TEST(ObstaclesAlong, AreNoneWhereTheMapLeavesRoom) {
  EXPECT_TRUE(along({{-2.0, 0.7}, {5.0, 0.7}}).empty());
  EXPECT_TRUE(along({{1.5, -2.0}, {1.5, 2.0}}).empty());
}

TEST(ObstaclesAlong, AHairTooCloseIsNotTooClose) {
  EXPECT_TRUE(along({{-2.0, 0.57}, {5.0, 0.57}}).empty());
  EXPECT_FALSE(along({{-2.0, 0.5}, {5.0, 0.5}}).empty());
}

TEST(ObstaclesAlong, AreTheNearestPointsOfWhatIsTooClose) {
  const auto beside = along({{-2.0, 0.4}, {1.5, 0.4}});
  ASSERT_FALSE(beside.empty());
  for (const Vector2& place : beside) {
    EXPECT_NEAR(place.y(), 0.2, 0.06);
    EXPECT_LT(std::abs(place.x()), 0.26);
  }
  const auto through = along({{-2.0, 0.0}, {5.0, 0.0}});
  for (const double x : {-0.2, 0.2, 2.8, 3.2}) {
    EXPECT_TRUE(std::any_of(through.begin(), through.end(), [&](const Vector2& place) {
      return (place - Vector2(x, 0.0)).norm() < 0.11;
    })) << x;
  }
  for (std::size_t i = 0; i < through.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE((through[i] - through[k]).norm(), 0.1);
  }
}

TEST(ObstaclesAlong, WhoBeginsTooCloseMayLeaveAndComeNoCloser) {
  EXPECT_TRUE(along({{0.0, 0.4}, {0.0, 2.0}}).empty());
  EXPECT_TRUE(along({{0.0, 0.4}, {0.3, 0.4}, {1.5, 1.0}}).empty());
  EXPECT_FALSE(along({{0.0, 0.4}, {0.0, 0.1}}).empty());
}

}  // namespace
}  // namespace mocha
