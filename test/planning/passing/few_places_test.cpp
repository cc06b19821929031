#include "planning/passing/few_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "world/obstacle.h"

namespace mocha {
namespace {

double farthest_off_m(const std::vector<Vector2>& places, const std::vector<Vector2>& path) {
  double farthest_m = 0.0;
  for (const Vector2& place : places) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < path.size(); ++i)
      nearest_m =
          std::min(nearest_m, (place - nearest_on_segment(place, path[i - 1], path[i])).norm());
    farthest_m = std::max(farthest_m, nearest_m);
  }
  return farthest_m;
}

TEST(FewPlaces, KeepTheShape) {
  std::vector<Vector2> spiral;
  for (int i = 0; i < 1000; ++i)
    spiral.emplace_back(0.01 * i * std::cos(0.02 * i), 0.01 * i * std::sin(0.02 * i));
  const std::vector<Vector2> few = few_places(spiral, 64);
  ASSERT_LE(few.size(), 64u);
  EXPECT_EQ(few.front(), spiral.front());
  EXPECT_EQ(few.back(), spiral.back());
  EXPECT_LT(farthest_off_m(spiral, few), 0.2);
  for (const Vector2& place : few)
    EXPECT_EQ(std::count(spiral.begin(), spiral.end(), place), 1) << "is one of them";
}

TEST(FewPlaces, KeepACornerWhereThereIsRoomForIt) {
  const std::vector<Vector2> bend = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {2.0, 2.0}};
  const std::vector<Vector2> corner = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}};
  EXPECT_EQ(few_places(bend, 5), corner);
  EXPECT_EQ(few_places(bend, 3), corner);
  const std::vector<Vector2> ends = {{0.0, 0.0}, {2.0, 2.0}};
  EXPECT_EQ(few_places(bend, 2), ends);
}

TEST(FewPlaces, AreTwoOfAStraightPath) {
  const std::vector<Vector2> straight = {{0.0, 0.0}, {1.0, 0.001}, {2.0, -0.001}, {3.0, 0.0}};
  EXPECT_EQ(few_places(straight, 8).size(), 2u);
  EXPECT_EQ(few_places(std::vector<Vector2>(500, Vector2(1.0, 2.0)), 8).size(), 2u);
}

TEST(FewPlaces, AreNoMoreThanThereAre) {
  EXPECT_TRUE(few_places({}, 8).empty());
  EXPECT_EQ(few_places({Vector2(1.0, 2.0)}, 8).size(), 1u);
}

}  // namespace
}  // namespace mocha
