#include "perception/mapping/column_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "perception/mapping/map_error.h"

namespace mocha {
namespace {

TEST(ColumnGridTest, RefusesEveryIndexThatIsTooFarAway) {
  constexpr int kLowest = std::numeric_limits<int>::min();
  constexpr int kHighest = std::numeric_limits<int>::max();
  ColumnGrid grid(0.05, 0, 3);
  grid.reserve({-5, -5, 0}, {5, 5, 0});
  for (const int odd : {kLowest, kLowest + 1, -32001, 32001, kHighest}) {
    for (const VoxelIndex& voxel : {VoxelIndex{odd, 0, 0}, VoxelIndex{0, odd, 0}}) {
      EXPECT_THROW(grid.reserve(voxel, {0, 0, 0}), MapError) << odd;
      EXPECT_THROW(grid.reserve({0, 0, 0}, voxel), MapError) << odd;
    }
  }
  EXPECT_TRUE(std::isnan(grid.log_odds({3, 3, 0})));
  grid.set({3, 3, 0}, 0.5f);
  EXPECT_EQ(grid.log_odds({3, 3, 0}), 0.5f);
}

TEST(ColumnGridTest, ACellIsOccupiedWhereAnyVoxelOfItsColumnIs) {
  ColumnGrid grid(0.05, 0, 3);
  const auto cell = [&] { return grid.slice(0).at(0, 0); };
  grid.set({-130, 7, 2}, -1.0f);
  EXPECT_EQ(cell(), OccupancyGrid::kFree);
  grid.set({-130, 7, 0}, 1.0f);
  grid.set({-130, 7, 3}, 1.0f);
  EXPECT_EQ(cell(), OccupancyGrid::kOccupied);
  grid.set({-130, 7, 0}, -1.0f);
  EXPECT_EQ(cell(), OccupancyGrid::kOccupied);
  const std::uint64_t version = grid.version();
  grid.set({-130, 7, 3}, -0.5f);
  EXPECT_EQ(cell(), OccupancyGrid::kFree);
  EXPECT_NE(grid.version(), version);
  EXPECT_EQ(grid.known(), (CornerWindow{-130, 7, -130, 7}));
}

}  // namespace
}  // namespace mocha
