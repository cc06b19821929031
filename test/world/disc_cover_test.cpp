#include "world/disc_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "world/obstacle.h"

namespace mocha {
namespace {

std::vector<Vector2> rectangle(double length_m, double width_m) {
  const double x = 0.5 * length_m;
  const double y = 0.5 * width_m;
  return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
}

/// A star-shaped polygon of 3 to 10 corners about the origin; most are not convex.
std::vector<Vector2> random_polygon(int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int corners = 3 + seed % 8;
  const double size_m = std::pow(10.0, -0.7 + 1.4 * unit(random));
  std::vector<Vector2> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.7 * unit(random)) / corners;
    const double away_m = size_m * (0.3 + 0.7 * unit(random));
    polygon.emplace_back(away_m * std::cos(angle), away_m * std::sin(angle));
  }
  return polygon;
}

bool is_covered(const Vector2& p, const std::vector<CoverDisc>& cover) {
  return std::any_of(cover.begin(), cover.end(), [&](const CoverDisc& disc) {
    return (p - disc.offset_m).norm() <= disc.radius_m + 1e-12;
  });
}

/// All over the body, its outline and its corners included.
void expect_covered(const std::vector<Vector2>& corners, const std::vector<CoverDisc>& cover) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Polygon body{corners};
  double size_m = 0.0;
  for (const Vector2& corner : corners) size_m = std::max(size_m, corner.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2& next = corners[(i + 1) % corners.size()];
    for (double share = 0.0; share < 1.0; share += 0.003) {
      const Vector2 p = corners[i] + share * (next - corners[i]);
      ASSERT_TRUE(is_covered(p, cover)) << p.transpose();
    }
  }
  for (int i = 0; i < 5000; ++i) {
    const Vector2 p = size_m * Vector2(2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0);
    if (gap(p, body).distance_m > 0.0) continue;
    ASSERT_TRUE(is_covered(p, cover)) << p.transpose();
  }
}

void expect_within(const std::vector<Vector2>& corners, const std::vector<CoverDisc>& cover,
                   double tolerance_m) {
  const Polygon body{corners};
  for (const CoverDisc& disc : cover) {
    for (double angle = 0.0; angle < 2.0 * M_PI; angle += 0.02) {
      const Vector2 rim = disc.offset_m + disc.radius_m * Vector2(std::cos(angle), std::sin(angle));
      ASSERT_LE(gap(rim, body).distance_m, tolerance_m + 1e-9);
    }
  }
}

TEST(DiscCover, HoldsEveryPointAndLittleElse) {
  for (int seed = 0; seed < 60; ++seed) {
    const std::vector<Vector2> corners = random_polygon(seed);
    for (const double tolerance_m : {0.01, 0.04}) {
      SCOPED_TRACE(::testing::Message() << "polygon " << seed << ", " << tolerance_m << " m");
      const std::vector<CoverDisc> cover = disc_cover(corners, tolerance_m);
      expect_covered(corners, cover);
      expect_within(corners, cover, tolerance_m);
      EXPECT_LE(cover.size(), 200u);
    }
  }
}

TEST(DiscCover, NeedsFewDiscs) {
  const auto count = [](const std::vector<Vector2>& corners, double tolerance_m) {
    return disc_cover(corners, tolerance_m).size();
  };
  EXPECT_LE(count(rectangle(0.508, 0.430), 0.01), 25u);
  EXPECT_LE(count(rectangle(0.9, 0.4), 0.01), 25u);
  EXPECT_LE(count(rectangle(1.5, 0.3), 0.01), 30u);
  EXPECT_LE(count(rectangle(10.0, 10.0), 0.01), 100u);
  EXPECT_LE(count(rectangle(0.508, 0.430), 0.04), 8u);
  const std::vector<Vector2> angle = {{-0.3, -0.3}, {0.6, -0.3}, {0.6, 0.1},
                                      {0.1, 0.1},   {0.1, 0.5},  {-0.3, 0.5}};
  EXPECT_LE(count(angle, 0.01), 40u);
}

/// How far p is from the discs, at most 0 inside.
double gap_m(const Vector2& p, const std::vector<CoverDisc>& cover) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const CoverDisc& disc : cover)
    least_m = std::min(least_m, (p - disc.offset_m).norm() - disc.radius_m);
  return least_m;
}

TEST(SoftDiscCover, LeavesOutAndReachesOutNoMoreThanItsTolerance) {
  for (int seed = 0; seed < 20; ++seed) {
    const std::vector<Vector2> corners = random_polygon(seed);
    for (const double tolerance_m : {0.02, 0.055}) {
      SCOPED_TRACE(::testing::Message() << "polygon " << seed << ", " << tolerance_m << " m");
      std::vector<CoverDisc> cover = soft_disc_cover(corners, tolerance_m);
      expect_within(corners, cover, tolerance_m);
      for (CoverDisc& disc : cover) {
        EXPECT_GT(disc.radius_m, 0.0);
        disc.radius_m += tolerance_m;
      }
      expect_covered(corners, cover);
      EXPECT_LE(cover.size(), disc_cover(corners, 2.0 * tolerance_m).size());
    }
  }
}

TEST(SoftDiscCover, OfARobotIsFewDiscsThatFavourNoSide) {
  const auto expect = [](double length_m, double width_m, std::size_t most) {
    const std::vector<Vector2> corners = rectangle(length_m, width_m);
    const std::vector<CoverDisc> cover = soft_disc_cover(corners, 0.055);
    EXPECT_LE(cover.size(), most);
    for (double x = -1.0; x <= 1.0; x += 0.125) {
      const Vector2 left(0.5 * length_m * x, 0.5 * width_m + 0.1);
      EXPECT_NEAR(gap_m(left, cover), gap_m({left.x(), -left.y()}, cover), 0.015) << left.x();
    }
  };
  expect(0.508, 0.430, 2);
  expect(0.271, 0.251, 1);
  expect(0.9, 0.6, 4);
}

TEST(DiscCover, CoversWhatIsSmallerThanItsTolerance) {
  const std::vector<Vector2> speck = rectangle(0.01, 0.002);
  const std::vector<CoverDisc> cover = disc_cover(speck, 0.01);
  expect_covered(speck, cover);
  expect_within(speck, cover, 0.01);
}

TEST(DiscCover, IsTheSameEveryTime) {
  const std::vector<CoverDisc> first = disc_cover(random_polygon(5), 0.01);
  const std::vector<CoverDisc> second = disc_cover(random_polygon(5), 0.01);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].offset_m, second[i].offset_m);
    EXPECT_EQ(first[i].radius_m, second[i].radius_m);
  }
}

}  // namespace
}  // namespace mocha
