#include "topology/static_map/obstacle_components.h"

#include <gtest/gtest.h>

#include "topology/grid_world.h"

namespace mocha {
namespace {

using Kind = ObstacleComponents::Kind;

/// Two crates, 0.4 m apart, on cells of 0.05 m.
class ObstacleComponentsTest : public ::testing::Test {
 protected:
  static OccupancyGrid two_crates() {
    OccupancyGrid grid = free_grid({0.0, 0.0}, {4.0, 2.0});
    fill_box(grid, {1.0, 0.5}, {1.6, 1.5});
    fill_box(grid, {2.0, 0.5}, {2.6, 1.5});
    return grid;
  }

  ObstacleComponents with(double clearance_m, Kind kind = Kind::kSolid) const {
    return {field_, field_.corners(), clearance_m, kind};
  }

  const DistanceField field_{two_crates(), DistanceField::Solid::kOccupied};
};

TEST_F(ObstacleComponentsTest, CratesWithAPassageBetweenAreTwo) {
  const ObstacleComponents components = with(0.15);
  ASSERT_EQ(components.size(), 2);
  EXPECT_EQ(components.at(25, 20), 0);
  EXPECT_EQ(components.at(45, 20), 1);
  EXPECT_EQ(components.at(36, 20), ObstacleComponents::kNone) << "between them";
  for (const Vector2& corner : components.solid(1)) {
    EXPECT_LE(field_.distance_bound(corner), 0.0);
    EXPECT_GT(corner.x(), 1.9);
  }
}

TEST_F(ObstacleComponentsTest, WithTheGapThatIsTooNarrowTheyAreOne) {
  const ObstacleComponents components = with(0.3);
  ASSERT_EQ(components.size(), 1);
  EXPECT_EQ(components.at(25, 20), 0);
  EXPECT_EQ(components.at(36, 20), 0);
  EXPECT_EQ(components.at(45, 20), 0);
  EXPECT_EQ(components.at(5, 20), ObstacleComponents::kNone);
}

TEST_F(ObstacleComponentsTest, AWindowThatShowsOnlyTheGapHasNoSolidComponent) {
  const CornerWindow gap{35, 15, 37, 25};
  EXPECT_EQ(ObstacleComponents(field_, gap, 0.3, Kind::kSolid).size(), 0);
  const ObstacleComponents any(field_, gap, 0.3, Kind::kAny);
  ASSERT_EQ(any.size(), 1);
  EXPECT_EQ(any.at(36, 20), 0);
  EXPECT_TRUE(any.solid(0).empty());
}

TEST_F(ObstacleComponentsTest, OnlyWhatIsNarrowerByMoreThanHalfACellIsNoPassage) {
  const CornerWindow middle{36, 15, 36, 25};  // 0.2 m from both crates
  EXPECT_EQ(ObstacleComponents(field_, middle, 0.21, Kind::kAny).size(), 0);
  EXPECT_EQ(ObstacleComponents(field_, middle, 0.24, Kind::kAny).size(), 1);
}

TEST_F(ObstacleComponentsTest, AnEmptyWindowHasNone) {
  EXPECT_EQ(ObstacleComponents(field_, {10, 10, 9, 9}, 0.3, Kind::kAny).size(), 0);
}

}  // namespace
}  // namespace mocha
