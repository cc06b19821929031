#include "world/distances/voxel_distance_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace mocha {
namespace {

using Eigen::Vector3d;
using Solid = VoxelDistanceField::Solid;

constexpr double kResolution_m = 0.2;

VoxelGrid random_grid(int seed) {
  std::mt19937 random(seed);
  VoxelGrid grid;
  grid.resolution_m = kResolution_m;
  grid.origin = {-1.0, 2.0, 0.4};
  grid.size = {14, 11, 9};
  std::discrete_distribution<int> kind({0.98, 0.01, 0.01});
  for (int i = 0; i < grid.size.prod(); ++i) {
    constexpr std::int8_t kKinds[] = {VoxelGrid::kFree, VoxelGrid::kOccupied, VoxelGrid::kUnknown};
    grid.cells.push_back(kKinds[kind(random)]);
  }
  return grid;
}

Eigen::AlignedBox3d cube(const VoxelGrid& grid, int x, int y, int z) {
  const Vector3d half = Vector3d::Constant(0.5 * grid.resolution_m);
  return {grid.cell_centre(x, y, z) - half, grid.cell_centre(x, y, z) + half};
}

/// To the nearest solid cell or the outside, by looking at all of them.
double distance_m(const VoxelGrid& grid, bool unknown_is_solid, const Vector3d& p) {
  const Eigen::AlignedBox3d box(grid.origin,
                                grid.origin + grid.resolution_m * grid.size.cast<double>());
  double least = std::min((p - box.min()).minCoeff(), (box.max() - p).minCoeff());
  for (int z = 0; z < grid.size.z(); ++z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      for (int x = 0; x < grid.size.x(); ++x) {
        const bool is_solid = grid.at(x, y, z) == VoxelGrid::kOccupied ||
                              (unknown_is_solid && grid.at(x, y, z) == VoxelGrid::kUnknown);
        if (is_solid) least = std::min(least, cube(grid, x, y, z).exteriorDistance(p));
      }
    }
  }
  return std::max(0.0, least);
}

class VoxelDistanceFieldTest : public testing::TestWithParam<int> {
 protected:
  Vector3d random_place(double beyond_m = 0.0) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Vector3d size = grid_.resolution_m * grid_.size.cast<double>();
    Vector3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = grid_.origin[axis] - beyond_m + share(random_) * (size[axis] + 2.0 * beyond_m);
    return p;
  }

  std::mt19937 random_{static_cast<unsigned>(GetParam())};
  const VoxelGrid grid_ = random_grid(GetParam());
};

TEST_P(VoxelDistanceFieldTest, NeverOverstates) {
  for (const Solid solid : {Solid::kOccupied, Solid::kOccupiedOrUnknown}) {
    const VoxelDistanceField field(grid_, solid);
    double sum_short_m = 0.0;
    for (int i = 0; i < 400; ++i) {
      Vector3d p = random_place();
      if (i % 2 == 0) {  // where the pieces that bounds are made of meet
        const double quarter_m = 0.25 * kResolution_m;
        p = grid_.origin + quarter_m * ((p - grid_.origin) / quarter_m).array().round().matrix();
      }
      const double truth_m = distance_m(grid_, solid == Solid::kOccupiedOrUnknown, p);
      const double bound_m = field.distance_bound(p);
      ASSERT_LE(bound_m, truth_m + 1e-6) << p.transpose();
      ASSERT_GE(bound_m, truth_m - kResolution_m) << p.transpose();
      sum_short_m += truth_m - bound_m;
    }
    EXPECT_LT(sum_short_m / 400, 0.3 * kResolution_m);
  }
}

TEST_P(VoxelDistanceFieldTest, IsExactAtTheCornersOfCells) {
  const VoxelDistanceField field(grid_, Solid::kOccupied);
  for (int i = 0; i < 200; ++i) {
    const Vector3d cell = ((random_place() - grid_.origin) / kResolution_m).array().round();
    const Vector3d corner = grid_.origin + kResolution_m * cell;
    EXPECT_NEAR(field.distance_bound(corner), distance_m(grid_, false, corner), 1e-5);
  }
}

TEST_P(VoxelDistanceFieldTest, TheGradientIsThatOfTheSampledDistance) {
  constexpr double kStep_m = 1e-6;
  const VoxelDistanceField field(grid_, Solid::kOccupied);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = random_place(0.5);
    const auto sample = field.sample(p);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = kStep_m * Vector3d::Unit(axis);
      const double slope =
          (field.sample(p + step).distance_m - field.sample(p - step).distance_m) / (2.0 * kStep_m);
      EXPECT_NEAR(sample.gradient[axis], slope, 1e-5) << p.transpose();
    }
  }
}

TEST_P(VoxelDistanceFieldTest, NothingIsNearWithinTheRoom) {
  const VoxelDistanceField field(grid_, Solid::kOccupied);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  int roomy = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = random_place(0.1);
    const double radius_m = 0.05;
    const double room_m = field.room(p, radius_m);
    if (!(room_m > 0.0)) continue;
    ++roomy;
    const Vector3d away =
        Vector3d(share(random_), share(random_), share(random_)).normalized() * 0.999 * room_m;
    EXPECT_GE(field.sample(p + away).distance_m, radius_m);
    const Vector3d half = Vector3d::Constant(0.999 * room_m / std::sqrt(3.0));
    EXPECT_TRUE(field.clear({p - half, p + half}, radius_m));
  }
  EXPECT_GT(roomy, 50);
}

INSTANTIATE_TEST_SUITE_P(Seeds, VoxelDistanceFieldTest, testing::Range(1, 6));

TEST(VoxelDistanceField, IsCloseBesideAWall) {
  VoxelGrid grid;
  grid.resolution_m = kResolution_m;
  grid.size = {30, 30, 30};
  for (int i = 0; i < 27000; ++i)
    grid.cells.push_back(i % 30 < 10 ? VoxelGrid::kOccupied : VoxelGrid::kFree);
  const VoxelDistanceField field(grid, Solid::kOccupied);
  for (double x = 2.3; x < 3.9; x += 0.013) {
    const double truth_m = x - 2.0;
    const double bound_m = field.distance_bound({x, 3.0 + 0.3 * std::sin(40.0 * x), 2.9});
    EXPECT_LE(bound_m, truth_m + 1e-6);
    EXPECT_GE(bound_m, truth_m - 0.3 * kResolution_m * kResolution_m / truth_m);
  }
}

/// All solid but for a tunnel along x of so many cells across.
VoxelGrid tunnel(int wide, int high) {
  VoxelGrid grid;
  grid.resolution_m = kResolution_m;
  grid.size = {60, wide + 2, high + 2};
  for (int i = 0; i < grid.size.prod(); ++i) {
    const int y = i / 60 % (wide + 2);
    const int z = i / 60 / (wide + 2);
    const bool is_open = y > 0 && y <= wide && z > 0 && z <= high;
    grid.cells.push_back(is_open ? VoxelGrid::kFree : VoxelGrid::kOccupied);
  }
  return grid;
}

TEST(VoxelDistanceField, IsCloseInTheMiddleOfNarrowWays) {
  for (const int wide : {5, 6, 7, 8, 9, 18, 19, 21, 40}) {
    for (const int high : {5, 6, 7, 8, 9, 18, 19, 21, 40}) {
      const VoxelDistanceField field(tunnel(wide, high), Solid::kOccupied);
      // Where rows of corners or of centres are, of which one is in the middle of the narrower way.
      const double shift = std::min(wide, high) % 2 == 0 ? 0.0 : 0.5;
      const double y = 1.0 + std::floor(0.5 * wide) + shift;
      const double z = 1.0 + std::floor(0.5 * high) + shift;
      const double truth = std::min({y - 1.0, wide + 1.0 - y, z - 1.0, high + 1.0 - z});
      for (double x = 28.0; x < 32.0; x += 0.07) {
        const double bound =
            field.distance_bound(kResolution_m * Vector3d(x, y, z)) / kResolution_m;
        EXPECT_LE(bound, truth + 1e-5);
        EXPECT_GE(bound, truth - 0.2) << wide << " " << high << " " << x;
      }
    }
  }
}

TEST(VoxelDistanceField, IsNegativeInsideOfWhatIsSolidAndOutside) {
  VoxelGrid grid;
  grid.resolution_m = kResolution_m;
  grid.size = {20, 20, 20};
  grid.cells.assign(8000, VoxelGrid::kFree);
  for (int z = 5; z < 15; ++z) {
    for (int y = 5; y < 15; ++y) {
      for (int x = 5; x < 15; ++x) grid.at(x, y, z) = VoxelGrid::kOccupied;
    }
  }
  const VoxelDistanceField field(grid, Solid::kOccupied);
  EXPECT_NEAR(field.sample({2.0, 2.0, 2.0}).distance_m, -1.0, 1e-5);
  EXPECT_NEAR(field.sample({1.4, 2.0, 2.0}).distance_m, -0.4, 1e-5);
  EXPECT_LT((field.sample({1.4, 2.0, 2.0}).gradient - Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-5);
  EXPECT_NEAR(field.sample({-0.5, 2.0, 2.0}).distance_m, -0.5, 1e-9);
  EXPECT_EQ(field.distance_bound({2.0, 2.0, 2.0}), 0.0);
  EXPECT_EQ(field.distance_bound({-0.5, 2.0, 2.0}), 0.0);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field.distance_bound({kNan, 2.0, 2.0}), 0.0);
  EXPECT_TRUE(std::isnan(field.sample({kNan, 2.0, 2.0}).distance_m));
  EXPECT_EQ(field.room({kNan, 2.0, 2.0}, 0.0), 0.0);
}

TEST(VoxelDistanceField, RefusesGridsThatAreNone) {
  VoxelGrid grid = random_grid(1);
  grid.cells.pop_back();
  EXPECT_THROW(VoxelDistanceField(grid, Solid::kOccupied), std::invalid_argument);
  EXPECT_THROW(VoxelDistanceField(VoxelGrid(), Solid::kOccupied), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
