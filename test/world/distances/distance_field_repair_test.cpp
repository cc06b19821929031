#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

#include "world/distances/distance_field.h"

namespace mocha {
namespace {

using Solid = DistanceField::Solid;

constexpr std::int8_t kValues[] = {OccupancyGrid::kFree, OccupancyGrid::kOccupied,
                                   OccupancyGrid::kUnknown};

OccupancyGrid plain(int width, int height) {
  OccupancyGrid grid;
  grid.width = width;
  grid.height = height;
  grid.cells.assign(static_cast<std::size_t>(width) * height, OccupancyGrid::kFree);
  return grid;
}

/// Rooms with some clutter, and much that has not been seen.
OccupancyGrid building(std::mt19937& random) {
  OccupancyGrid grid;
  grid.width = 150 + static_cast<int>(random() % 50);
  grid.height = 120;
  grid.origin = {-2.0, 1.0};
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kFree);
  for (int i = 0; i < 8; ++i) {
    const bool upright = random() % 2 == 0;
    const int at = static_cast<int>(random() % (upright ? grid.width : grid.height));
    for (int k = 0; k < (upright ? grid.height : grid.width); ++k) {
      if (k % 40 > 12) grid.at(upright ? at : k, upright ? k : at) = OccupancyGrid::kOccupied;
    }
  }
  for (int i = 0; i < 400; ++i) grid.cells[random() % grid.cells.size()] = OccupancyGrid::kUnknown;
  return grid;
}

/// Repairs a field where cells of its map have changed, and expects it to be as if made anew, and
/// told about where it differs.
void expect_repaired(DistanceField& field, const OccupancyGrid& grid, Solid solid,
                     const std::vector<CornerWindow>& cells) {
  const DistanceField before = field;
  const std::vector<CornerWindow> differ = field.repair(grid, cells);
  const DistanceField fresh(grid, solid);
  for (int y = 0; y < field.rows(); ++y) {
    for (int x = 0; x < field.columns(); ++x) {
      ASSERT_EQ(field.at_corner(x, y), fresh.at_corner(x, y)) << x << " " << y;
      if (field.at_corner(x, y) == before.at_corner(x, y)) continue;
      EXPECT_TRUE(std::any_of(differ.begin(), differ.end(),
                              [&](const CornerWindow& window) { return window.holds(x, y); }))
          << x << " " << y;
    }
  }
}

/// Up to so many cells along each side, with values at random.
CornerWindow scrambled(OccupancyGrid& grid, int most, std::mt19937& random) {
  const int x0 = static_cast<int>(random() % grid.width);
  const int y0 = static_cast<int>(random() % grid.height);
  const CornerWindow cells{x0, y0, std::min(x0 + static_cast<int>(random() % most), grid.width - 1),
                           std::min(y0 + static_cast<int>(random() % most), grid.height - 1)};
  for (int y = cells.y0; y <= cells.y1; ++y) {
    for (int x = cells.x0; x <= cells.x1; ++x) grid.at(x, y) = kValues[random() % 3];
  }
  return cells;
}

class DistanceFieldRepair : public ::testing::TestWithParam<Solid> {};

TEST_P(DistanceFieldRepair, IsAsIfMadeAnew) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 60; ++trial) {
    OccupancyGrid grid = building(random);
    if (trial % 10 == 0) std::fill(grid.cells.begin(), grid.cells.end(), OccupancyGrid::kFree);
    DistanceField field(grid, GetParam());
    const CornerWindow cells = scrambled(grid, 12, random);
    expect_repaired(field, grid, GetParam(), {cells});
  }
}

TEST_P(DistanceFieldRepair, OfSingleCellsIsAsIfMadeAnew) {
  std::mt19937 random(4);
  OccupancyGrid grid = building(random);
  DistanceField field(grid, GetParam());
  for (int trial = 0; trial < 150; ++trial) {
    std::vector<CornerWindow> cells;
    for (int i = 0; i < 3; ++i) cells.push_back(scrambled(grid, 1, random));
    expect_repaired(field, grid, GetParam(), cells);
  }
}

TEST_P(DistanceFieldRepair, OfManyWindowsInASparseWorldIsAsIfMadeAnew) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 40; ++trial) {
    OccupancyGrid grid = plain(500, 300);
    for (int i = 0; i < 6; ++i) grid.cells[random() % grid.cells.size()] = OccupancyGrid::kOccupied;
    DistanceField field(grid, GetParam());
    for (int round = 0; round < 3; ++round) {
      std::vector<CornerWindow> cells;
      for (int i = 0; i < 4; ++i) cells.push_back(scrambled(grid, i == 0 ? 9 : 2, random));
      expect_repaired(field, grid, GetParam(), cells);
    }
  }
}

TEST_P(DistanceFieldRepair, OfWhatAllDependsOnIsAsIfMadeAnew) {
  OccupancyGrid grid = plain(200, 200);
  grid.at(100, 50) = grid.at(20, 150) = OccupancyGrid::kOccupied;
  DistanceField field(grid, GetParam());
  for (const CornerWindow& where : {CornerWindow{100, 50, 100, 50}, {20, 150, 20, 150}}) {
    grid.at(where.x0, where.y0) = OccupancyGrid::kFree;
    expect_repaired(field, grid, GetParam(), {where});
  }
}

TEST_P(DistanceFieldRepair, OfALongCorridorIsAsIfMadeAnew) {
  OccupancyGrid grid = plain(4000, 3);
  grid.at(0, 1) = grid.at(3999, 2) = OccupancyGrid::kOccupied;
  DistanceField field(grid, GetParam());
  for (const int x : {3000, 3990, 1500}) {
    for (const std::int8_t value : {OccupancyGrid::kOccupied, OccupancyGrid::kFree}) {
      grid.at(x, 1) = value;
      expect_repaired(field, grid, GetParam(), {{x, 1, x, 1}});
    }
  }
}

TEST_P(DistanceFieldRepair, OfNothingTellsNothing) {
  std::mt19937 random(5);
  const OccupancyGrid grid = building(random);
  DistanceField field(grid, GetParam());
  EXPECT_TRUE(field.repair(grid, {{20, 20, 40, 40}}).empty());
}

TEST_P(DistanceFieldRepair, RefusesAnotherMap) {
  std::mt19937 random(5);
  OccupancyGrid grid = building(random);
  DistanceField field(grid, GetParam());
  grid.origin.x() += 0.05;
  EXPECT_THROW(field.repair(grid, {{20, 20, 40, 40}}), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Both, DistanceFieldRepair,
                         ::testing::Values(Solid::kOccupied, Solid::kOccupiedOrUnknown));

}  // namespace
}  // namespace mocha
