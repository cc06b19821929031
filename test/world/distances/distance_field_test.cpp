#include "world/distances/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mocha {
namespace {

OccupancyGrid random_grid(int seed, int8_t rest) {
  std::mt19937 random(seed);
  OccupancyGrid grid;
  grid.resolution_m = 0.1;
  grid.origin = {-1.0, 0.5};
  grid.width = 23;
  grid.height = 17;
  grid.cells.assign(grid.width * grid.height, rest);
  std::uniform_int_distribution<int> x(0, grid.width - 1);
  std::uniform_int_distribution<int> y(0, grid.height - 1);
  for (int i = 0; i < 12; ++i) grid.at(x(random), y(random)) = OccupancyGrid::kOccupied;
  return grid;
}

/// Distance to the union of the closed occupied squares, cell by cell.
double brute_force(const OccupancyGrid& grid, const Vector2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (grid.at(x, y) != OccupancyGrid::kOccupied) continue;
      const Vector2 low = grid.origin + grid.resolution_m * Vector2(x, y);
      const Vector2 high = low + Vector2::Constant(grid.resolution_m);
      nearest = std::min(nearest, (p - p.cwiseMax(low).cwiseMin(high)).norm());
    }
  }
  return nearest;
}

TEST(DistanceField, IsExactAtCorners) {
  for (int seed = 1; seed <= 20; ++seed) {
    const OccupancyGrid grid = random_grid(seed, OccupancyGrid::kUnknown);
    const DistanceField field(grid, DistanceField::Solid::kOccupied);
    for (int y = 0; y < field.rows(); ++y) {
      for (int x = 0; x < field.columns(); ++x) {
        const double expected = brute_force(grid, field.corner(x, y));
        EXPECT_NEAR(std::max(0.0, field.at_corner(x, y)), expected, 1e-6);
      }
    }
  }
}

/// How far the bound may fall short of the distance, in cells: midway between four squares that
/// stand diagonally to a cell, sqrt(4.5) - sqrt(1.5). Elsewhere it is less.
constexpr double kMostShort = 0.8966;

TEST(DistanceField, BoundIsNeverAboveTheDistanceAndClose) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-2.0, 2.5);
  std::uniform_real_distribution<double> y(-0.5, 3.0);
  for (int seed = 1; seed <= 10; ++seed) {
    const OccupancyGrid grid = random_grid(seed, OccupancyGrid::kFree);
    const DistanceField field(grid, DistanceField::Solid::kOccupied);
    for (int i = 0; i < 2000; ++i) {
      const Vector2 p(x(random), y(random));
      const double bound = field.distance_bound(p);
      const double distance = brute_force(grid, p);
      EXPECT_LE(bound, distance + 1e-6);
      const bool inside = (p - grid.origin).minCoeff() > 0.0 && p.x() < 1.3 && p.y() < 2.2;
      if (inside) {
        EXPECT_GE(bound, distance - kMostShort * grid.resolution_m);
      }
    }
  }
}

TEST(DistanceField, BoundFallsShortMostBetweenFourSquares) {
  OccupancyGrid grid = random_grid(7, OccupancyGrid::kFree);
  std::fill(grid.cells.begin(), grid.cells.end(), OccupancyGrid::kFree);
  for (const int x : {8, 12}) {
    for (const int y : {6, 10}) grid.at(x, y) = OccupancyGrid::kOccupied;
  }
  const DistanceField field(grid, DistanceField::Solid::kOccupied);
  const Vector2 between = grid.origin + grid.resolution_m * Vector2(10.5, 8.5);
  const double short_cells =
      (brute_force(grid, between) - field.distance_bound(between)) / grid.resolution_m;
  EXPECT_NEAR(short_cells, kMostShort, 1e-4);
}

TEST(DistanceField, BoundIsTightBesideOneObstacle) {
  OccupancyGrid grid = random_grid(7, OccupancyGrid::kFree);
  std::fill(grid.cells.begin(), grid.cells.end(), OccupancyGrid::kFree);
  grid.at(2, 2) = OccupancyGrid::kOccupied;
  const DistanceField field(grid, DistanceField::Solid::kOccupied);
  const double cell = grid.resolution_m;
  for (double x = 0.05; x < 2.2; x += 0.037) {
    const Vector2 p = grid.origin + Vector2(x, 0.9);
    const double distance = brute_force(grid, p);
    EXPECT_LE(field.distance_bound(p), distance + 1e-6);
    EXPECT_GE(field.distance_bound(p), distance - 0.3 * cell * cell / distance);
  }
}

TEST(DistanceField, UnknownAndOutsideAreSolidOnRequest) {
  OccupancyGrid grid = random_grid(1, OccupancyGrid::kUnknown);
  std::fill(grid.cells.begin(), grid.cells.end(), OccupancyGrid::kFree);
  grid.at(5, 5) = OccupancyGrid::kUnknown;
  const DistanceField field(grid, DistanceField::Solid::kOccupiedOrUnknown);
  EXPECT_EQ(field.distance_bound(grid.cell_centre(5, 5)), 0.0);
  EXPECT_EQ(field.distance_bound(grid.origin - Vector2(1.0, 1.0)), 0.0);
  EXPECT_NEAR(field.distance_bound(grid.origin + Vector2(0.2, 1.2)), 0.2, 1e-6);  // to the rim
  const DistanceField open(grid, DistanceField::Solid::kOccupied);
  EXPECT_GT(open.distance_bound(grid.cell_centre(5, 5)), 100.0);
}

TEST(DistanceField, GradientIsThatOfTheInterpolation) {
  const DistanceField field(random_grid(2, OccupancyGrid::kFree), DistanceField::Solid::kOccupied);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> inside(0.02, 0.08);
  for (int i = 0; i < 200; ++i) {
    const Vector2 p = field.corner(i % 21, i % 15) + Vector2(inside(random), inside(random));
    const auto sample = field.sample(p);
    constexpr double kStep = 1e-5;
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2 step = kStep * Vector2::Unit(axis);
      const double slope =
          (field.sample(p + step).distance_m - field.sample(p - step).distance_m) / (2 * kStep);
      EXPECT_NEAR(sample.gradient[axis], slope, 1e-6);
    }
  }
}

TEST(DistanceField, PushesOutOfTheInside) {
  OccupancyGrid grid = random_grid(1, OccupancyGrid::kFree);
  std::fill(grid.cells.begin(), grid.cells.end(), OccupancyGrid::kFree);
  for (int y = 4; y < 12; ++y) {
    for (int x = 4; x < 16; ++x) grid.at(x, y) = OccupancyGrid::kOccupied;
  }
  const DistanceField field(grid, DistanceField::Solid::kOccupied);
  const auto sample = field.sample(grid.origin + Vector2(0.55, 0.8));  // 0.15 inside the left face
  EXPECT_NEAR(sample.distance_m, -0.15, 1e-6);
  EXPECT_LT(sample.gradient.x(), -0.9);
}

TEST(DistanceField, SamplesOutsideAgreeWithWhatIsProvedThere) {
  const DistanceField field(random_grid(2, OccupancyGrid::kFree), DistanceField::Solid::kOccupied);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> anywhere(-3.0, 4.0);
  constexpr double kStep = 1e-6;
  int outside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector2 p(anywhere(random), anywhere(random));
    const Vector2 at = (p - field.origin()) / field.resolution_m();
    if (at.minCoeff() >= 0.0 && at.x() <= field.columns() - 1 && at.y() <= field.rows() - 1)
      continue;
    ++outside;
    const auto sample = field.sample(p);
    EXPECT_NEAR(sample.distance_m, field.distance_bound(p), 0.5 * field.resolution_m());
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2 step = kStep * Vector2::Unit(axis);
      const double slope =
          (field.sample(p + step).distance_m - field.sample(p - step).distance_m) / (2 * kStep);
      EXPECT_NEAR(sample.gradient[axis], slope, 1e-5);
    }
  }
  EXPECT_GT(outside, 1000);
}

TEST(DistanceField, ShowsItsNearestDistanceAloneWhereItIsClose) {
  const DistanceField field(random_grid(2, OccupancyGrid::kFree), DistanceField::Solid::kOccupied);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> x(-1.0, 1.3);
  std::uniform_real_distribution<double> y(0.5, 2.2);
  constexpr double kRadius_m = 0.3;
  int shown = 0;
  int held_back = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector2 p(x(random), y(random));
    const auto nearest = field.sample(p);
    int visits = 0;
    field.visit_near(p, kRadius_m, [&](const auto& sample) {
      ++visits;
      EXPECT_EQ(sample.distance_m, nearest.distance_m);
      EXPECT_EQ(sample.gradient, nearest.gradient);
    });
    EXPECT_EQ(visits, nearest.distance_m < kRadius_m ? 1 : 0);
    ++(visits == 1 ? shown : held_back);
  }
  EXPECT_GT(shown, 50);
  EXPECT_GT(held_back, 50);
}

TEST(DistanceField, NothingIsNearWithinTheRoomOrInAClearBox) {
  const DistanceField field(random_grid(2, OccupancyGrid::kFree), DistanceField::Solid::kOccupied);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> x(-2.0, 2.3);
  std::uniform_real_distribution<double> y(-0.5, 3.2);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto is_near = [&](const Vector2& p, double radius_m) {
    bool near = false;
    field.visit_near(p, radius_m, [&](const auto&) { near = true; });
    return near;
  };
  int roomy = 0;
  int clear = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector2 p(x(random), y(random));
    const double radius_m = 0.5 * share(random);
    const double room_m = field.room(p, radius_m);
    const double angle = 2.0 * M_PI * share(random);
    if (is_near(p, radius_m)) {
      EXPECT_EQ(room_m, 0.0);
    }
    if (room_m > 0.0) {
      ++roomy;
      const Vector2 step(std::cos(angle), std::sin(angle));
      EXPECT_FALSE(is_near(p + 0.999 * share(random) * room_m * step, radius_m));
    }
    const Vector2 size(0.3 * share(random), 0.3 * share(random));
    if (!field.clear({p, p + size}, radius_m)) continue;
    ++clear;
    EXPECT_FALSE(
        is_near(p + Vector2(share(random) * size.x(), share(random) * size.y()), radius_m));
  }
  EXPECT_GT(roomy, 5000);
  EXPECT_GT(clear, 3000);
}

TEST(DistanceField, WhatIsNotFiniteIsNowhere) {
  const DistanceField field(random_grid(2, OccupancyGrid::kFree), DistanceField::Solid::kOccupied);
  for (const Vector2& p : {Vector2(NAN, 0.0), Vector2(0.0, NAN), Vector2(0.0, -INFINITY)}) {
    EXPECT_TRUE(std::isnan(field.sample(p).distance_m));
    EXPECT_EQ(field.distance_bound(p), 0.0);
  }
}

TEST(DistanceField, RefusesEmptyGrids) {
  EXPECT_THROW(DistanceField(OccupancyGrid{}, DistanceField::Solid::kOccupied),
               std::invalid_argument);
}

TEST(OccupancyGrid, GrowsAndFills) {
  OccupancyGrid grid = random_grid(4, OccupancyGrid::kFree);
  const OccupancyGrid grown = grown_to_hold(grid, {{5.0, -3.0}}, 0.5);
  EXPECT_LE((grown.origin - Vector2(-1.0, -3.5)).norm(), 0.11);
  EXPECT_GE(grown.origin.x() + grown.width * grown.resolution_m, 5.5 - 1e-9);
  const Vector2 shift = (grid.origin - grown.origin) / grid.resolution_m;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      EXPECT_EQ(grid.at(x, y), grown.at(x + std::lround(shift.x()), y + std::lround(shift.y())));
    }
  }
  EXPECT_EQ(grown.at(grown.width - 1, 0), OccupancyGrid::kUnknown);
}

}  // namespace
}  // namespace mocha
