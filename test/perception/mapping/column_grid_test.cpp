#include "perception/mapping/column_grid.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(grid.at({3, 3, 0}), VoxelState::kUnknown);
  grid.set({3, 3, 0}, VoxelState::kOccupied);
  EXPECT_EQ(grid.at({3, 3, 0}), VoxelState::kOccupied);
}

}  // namespace
}  // namespace mocha
