#include "perception/localization/likelihood_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mocha {
namespace {

OccupancyGrid grid_of(int width, int height) {
  OccupancyGrid grid;
  grid.resolution_m = 0.05;
  grid.origin = {-1.0, 2.0};
  grid.width = width;
  grid.height = height;
  grid.cells.assign(static_cast<std::size_t>(width) * height, OccupancyGrid::kFree);
  return grid;
}

TEST(LikelihoodFieldTest, DistancesAreThoseToTheNearestOccupiedCentre) {
  OccupancyGrid grid = grid_of(40, 30);
  std::mt19937 random(3);
  std::vector<Vector2> walls;
  for (int i = 0; i < 25; ++i) {
    const int x = static_cast<int>(random() % 40);
    const int y = static_cast<int>(random() % 30);
    grid.at(x, y) = OccupancyGrid::kOccupied;
    walls.push_back(grid.cell_centre(x, y));
  }
  const LikelihoodField field(grid, 0.4);
  for (int y = 1; y < 29; ++y) {
    for (int x = 1; x < 39; ++x) {
      double nearest = 0.4;
      for (const Vector2& wall : walls)
        nearest = std::min(nearest, (grid.cell_centre(x, y) - wall).norm());
      EXPECT_NEAR(field.sample(grid.cell_centre(x, y)).distance_m, nearest, 1e-6);
    }
  }
}

TEST(LikelihoodFieldTest, TheGradientIsThatOfTheDistance) {
  OccupancyGrid grid = grid_of(40, 30);
  grid.at(10, 12) = grid.at(11, 12) = grid.at(30, 20) = OccupancyGrid::kOccupied;
  const LikelihoodField field(grid, 1.0);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0.1, 0.9);
  for (int i = 0; i < 200; ++i) {
    const Vector2 p = grid.cell_centre(random() % 38, random() % 28) +
                      grid.resolution_m * Vector2(share(random), share(random));
    constexpr double kStep = 1e-6;
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2 by = kStep * Vector2::Unit(axis);
      const double slope =
          (field.sample(p + by).distance_m - field.sample(p - by).distance_m) / (2.0 * kStep);
      EXPECT_NEAR(field.sample(p).gradient[axis], slope, 1e-6);
    }
  }
}

TEST(LikelihoodFieldTest, OutsideTheMapNothingIsKnown) {
  OccupancyGrid grid = grid_of(10, 10);
  grid.at(0, 0) = OccupancyGrid::kOccupied;
  const LikelihoodField field(grid, 0.5);
  for (const Vector2& p : {Vector2(-1.6, 2.2), Vector2(5.0, 2.2), Vector2(-0.8, 1.0),
                           Vector2(NAN, 2.2), Vector2(-0.8, INFINITY)}) {
    EXPECT_EQ(field.sample(p).distance_m, 0.5);
    EXPECT_EQ(field.sample(p).gradient, Vector2(0.0, 0.0));
    EXPECT_EQ(field.cell(p), OccupancyGrid::kUnknown);
  }
  EXPECT_EQ(field.cell({-0.99, 2.01}), OccupancyGrid::kOccupied);
  EXPECT_EQ(field.cell({-0.99, 2.06}), OccupancyGrid::kFree);
}

TEST(LikelihoodFieldTest, AWallAtTheRimReachesOut) {
  OccupancyGrid grid = grid_of(10, 10);
  for (int y = 0; y < 10; ++y) grid.at(9, y) = OccupancyGrid::kOccupied;
  const LikelihoodField field(grid, 0.5);
  const double wall_x_m = grid.cell_centre(9, 5).x();
  for (const double behind_m : {-0.1, 0.05, 0.2, 0.4}) {
    const Vector2 p(wall_x_m + behind_m, 2.25);
    EXPECT_NEAR(field.sample(p).distance_m, std::abs(behind_m), 1e-6);
    EXPECT_NEAR(field.sample(p).gradient.x(), behind_m > 0.0 ? 1.0 : -1.0, 1e-6);
    EXPECT_EQ(field.cell(p), behind_m > 0.0 ? OccupancyGrid::kUnknown : OccupancyGrid::kFree);
  }
}

TEST(LikelihoodFieldTest, RefusesAnEmptyGrid) {
  EXPECT_THROW(LikelihoodField(OccupancyGrid{}, 0.5), std::invalid_argument);
  OccupancyGrid grid = grid_of(10, 10);
  grid.cells.pop_back();
  EXPECT_THROW(LikelihoodField(grid, 0.5), std::invalid_argument);
}

TEST(LikelihoodFieldTest, RefusesCellsAndCornersThatNoMapHas) {
  for (const double odd : {double{NAN}, double{INFINITY}, -0.05, 0.0, 1e-300, 1e-4, 11.0, 1e300}) {
    OccupancyGrid grid = grid_of(10, 10);
    grid.resolution_m = odd;
    EXPECT_THROW(LikelihoodField(grid, 0.5), std::invalid_argument) << odd;
  }
  for (const double odd : {double{NAN}, double{INFINITY}, -1e300, 1e5}) {
    OccupancyGrid grid = grid_of(10, 10);
    grid.origin.y() = odd;
    EXPECT_THROW(LikelihoodField(grid, 0.5), std::invalid_argument) << odd;
  }
}

}  // namespace
}  // namespace mocha
