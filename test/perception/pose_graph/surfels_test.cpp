#include "perception/pose_graph/surfels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mocha {
namespace {

constexpr std::size_t kAll = 1000;

/// A wall through (2, 0), at `angle_rad` to the y axis, seen from the origin.
ScanHits wall(double angle_rad, double noise_m, double spacing_m = 0.05) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1.0);
  ScanHits scan;
  for (double along_m = -1.0; along_m < 1.0; along_m += spacing_m) {
    const Vector2 hit =
        Vector2(2.0, 0.0) + along_m * Vector2(-std::sin(angle_rad), std::cos(angle_rad));
    scan.hits.push_back(hit + noise_m * noise(random) * hit.normalized());
  }
  return scan;
}

TEST(SurfelsTest, FaceTheSensor) {
  for (const double angle_rad : {-0.7, 0.0, 0.5}) {
    const auto surfels = surfels_of(wall(angle_rad, 0.0), kAll);
    ASSERT_EQ(surfels.size(), wall(angle_rad, 0.0).hits.size());
    const Vector2 expected(-std::cos(angle_rad), -std::sin(angle_rad));
    for (const Surfel& surfel : surfels) EXPECT_LT((surfel.normal - expected).norm(), 1e-6);
  }
}

TEST(SurfelsTest, LieOnTheWallThatNoisyHitsMake) {
  const auto surfels = surfels_of(wall(0.0, 0.02), kAll);
  EXPECT_GT(surfels.size(), 30u);
  for (const Surfel& surfel : surfels) {
    EXPECT_LT(std::abs(surfel.point.x() - 2.0), 0.025);
    EXPECT_GT(-surfel.normal.x(), std::cos(0.25));
  }
}

TEST(SurfelsTest, AreNotMadeOfScatteredHits) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-0.15, 0.15);
  ScanHits scan;
  for (int i = 0; i < 20; ++i) scan.hits.emplace_back(2.0 + place(random), place(random));
  EXPECT_LT(surfels_of(scan, kAll).size(), 4u);
  scan.hits = {{2.0, 0.0}, {2.0, 3.0}, {2.0, -3.0}};
  EXPECT_TRUE(surfels_of(scan, kAll).empty());
  EXPECT_TRUE(surfels_of(ScanHits{}, kAll).empty());
}

TEST(SurfelsTest, AreAtMostSoMany) { EXPECT_EQ(surfels_of(wall(0.0, 0.0), 7).size(), 7u); }

TEST(SurfelsTest, AreTurnedAndMoved) {
  const Surfel surfel = placed({{1.0, 2.0}, M_PI_2}, {{3.0, 0.0}, {-1.0, 0.0}});
  EXPECT_LT((surfel.point - Vector2(1.0, 5.0)).norm(), 1e-12);
  EXPECT_LT((surfel.normal - Vector2(0.0, -1.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace mocha
