#include "planning/passing/place_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mocha {
namespace {

std::vector<Vector2> lattice(double width_m, double height_m) {
  std::vector<Vector2> points;
  for (int y = 0; 0.1 * y < height_m + 1e-9; ++y) {
    for (int x = 0; 0.1 * x < width_m + 1e-9; ++x) points.emplace_back(0.1 * x, 0.1 * y);
  }
  return points;
}

double least_gap_m(const std::vector<Vector2>& points) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least_m = std::min(least_m, (points[i] - points[j]).norm());
  }
  return least_m;
}

std::vector<Vector2> chosen(const std::vector<Vector2>& candidates,
                            const std::vector<Vector2>& fixed, double apart_m) {
  std::vector<Vector2> points = fixed;
  for (const int i : packed(candidates, fixed, apart_m)) points.push_back(candidates[i]);
  return points;
}

TEST(PlacePacking, CorridorIsFilledWithoutGaps) {
  for (const double length_m : {2.95, 3.95, 7.25, 12.05}) {
    const auto points = chosen(lattice(length_m, 0.3), {}, 0.95);
    // As many as fit on a line of a lattice of 0.1 m, where each takes 1 m.
    EXPECT_GE(static_cast<int>(points.size()), static_cast<int>(length_m) + 1) << length_m;
    EXPECT_GE(least_gap_m(points), 0.95);
  }
}

TEST(PlacePacking, EveryCandidateIsNearAChosenOne) {
  const auto candidates = lattice(6.0, 4.0);
  const std::vector<Vector2> fixed = {{1.234, 2.345}, {1.9, 2.345}};  // closer than asked
  const auto points = chosen(candidates, fixed, 0.95);
  for (const Vector2& candidate : candidates) {
    const auto gap_m = [&](const Vector2& point) { return (point - candidate).norm(); };
    const auto nearest =
        std::min_element(points.begin(), points.end(),
                         [&](const Vector2& a, const Vector2& b) { return gap_m(a) < gap_m(b); });
    EXPECT_LT(gap_m(*nearest), 0.95);
  }
  const std::vector<Vector2> added(points.begin() + 1, points.end());
  EXPECT_GE(least_gap_m(added), 0.95);
  EXPECT_GT(points.size(), 20u);
}

TEST(PlacePacking, SettlesWhereThereIsRoom) {
  const auto candidates = lattice(6.0, 1.0);  // a corridor, roomiest in its midst
  std::vector<double> room_m;
  for (const Vector2& place : candidates)
    room_m.push_back(std::min(0.2, 0.5 - std::abs(place.y() - 0.5)));
  const std::vector<Vector2> fixed = {{0.0, 0.0}};
  const std::vector<int> chosen = {10, 25, 60 + 10 * 61};  // at (1, 0), (2.5, 0) and (6, 1)
  std::vector<Vector2> points = fixed;
  for (const int i : settled(chosen, candidates, room_m, fixed, 0.95, 0.15)) {
    EXPECT_NEAR(room_m[i], 0.2, 0.02);
    points.push_back(candidates[i]);
  }
  ASSERT_EQ(points.size(), 4u);
  EXPECT_GE(least_gap_m(points), 0.95 + 0.15) << "the first was nearer than that to what is fixed";
  EXPECT_LT((points[3] - Vector2(6.0, 1.0)).norm(), 0.5) << "farther than it had to go";
}

TEST(PlacePacking, NothingToChooseFrom) {
  EXPECT_TRUE(settled({}, {}, {}, {}, 1.0, 0.1).empty());
  EXPECT_TRUE(packed({}, {}, 1.0).empty());
  EXPECT_TRUE(packed({{0.0, 0.0}, {0.3, 0.0}}, {{0.1, 0.0}}, 1.0).empty());
}

}  // namespace
}  // namespace mocha
