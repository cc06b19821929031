#include "topology/roadmaps/bisector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

const Circle kPairs[][2] = {
    {{{0.0, 0.0}, 1.0}, {{3.0, 1.0}, 1.0}},     // equal: straight
    {{{0.0, 0.0}, 1.5}, {{3.0, 1.0}, 0.2}},     // bent round the second
    {{{3.0, 1.0}, 0.0}, {{0.0, 0.0}, 2.0}},     // bent round the first, a point
    {{{-1e4, 0.0}, 1e4}, {{2.0, 1.0}, 0.3}},    // a virtual wall
    {{{0.0, 0.0}, 1.0}, {{0.9, 0.0}, 0.1001}},  // almost inside
    {{{0.0, 0.0}, 1.0}, {{0.5, 0.5}, 0.8}},     // overlapping
};

TEST(Bisector, IsEquallyFarFromBoth) {
  for (const auto& [first, second] : kPairs) {
    const Bisector bisector(first, second);
    for (double t = -1.5; t <= 1.5; t += 0.1) {
      const Vector2 p = bisector.at(t);
      EXPECT_NEAR(gap(p, first).distance_m, bisector.clearance_m(t), 1e-10);
      EXPECT_NEAR(gap(p, second).distance_m, bisector.clearance_m(t), 1e-10);
    }
  }
}

TEST(Bisector, FindsTheParameterOfAPoint) {
  for (const auto& [first, second] : kPairs) {
    const Bisector bisector(first, second);
    for (double t = -3.0; t <= 3.0; t += 0.06) {
      EXPECT_NEAR(bisector.parameter(bisector.at(t)), t, 1e-8);
    }
    for (double t = 0.3; t < 3.0; t += 0.3) {
      EXPECT_NEAR(bisector.reach(bisector.clearance_m(t)), t, 1e-6);
    }
    EXPECT_EQ(bisector.reach(bisector.clearance_m(0.0) - 0.01), 0.0);
  }
}

TEST(Bisector, IsARayWhereOneTouchesTheOtherFromInside) {
  const Bisector ray({{0.0, 0.0}, 1.0}, {{0.75, 0.0}, 0.25});
  EXPECT_EQ(ray.at(2.0).y(), 0.0);
  EXPECT_NEAR(std::abs(ray.parameter(ray.at(2.0))), 2.0, 1e-12);
  EXPECT_TRUE(ray.corners(1.0, 3.0, 0.02).empty());
}

TEST(Bisector, CornersLoseLittleClearance) {
  for (const auto& [first, second] : kPairs) {
    const Bisector bisector(first, second);
    const double from = bisector.clearance_m(0.0) > 0.0 ? -2.0 : bisector.reach(0.01);
    std::vector<Vector2> line = bisector.corners(from, 2.5, 0.02);
    EXPECT_EQ(line.empty(), first.radius_m == second.radius_m);
    EXPECT_LT(line.size(), 100u);
    line.insert(line.begin(), bisector.at(from));
    line.push_back(bisector.at(2.5));
    for (std::size_t i = 1; i < line.size(); ++i) {
      for (double s = 0.0; s <= 1.0; s += 0.05) {
        const Vector2 p = line[i - 1] + s * (line[i] - line[i - 1]);
        const double nearer = std::min(gap(p, first).distance_m, gap(p, second).distance_m);
        const double true_m = bisector.clearance_m(bisector.parameter(p));
        EXPECT_GT(nearer, 0.95 * true_m);
      }
    }
  }
}

}  // namespace
}  // namespace mocha
