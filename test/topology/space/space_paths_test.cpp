#include "topology/space/space_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "world/space_worlds.h"

namespace mocha {
namespace {

using Eigen::Vector3d;

const auto kGoOn = [] { return false; };

class SpacePathsTest : public testing::Test {
 protected:
  void use(const SpaceWorld& world, double clearance_m = 0.3) {
    world_ = world;
    clearance_m_ = clearance_m;
    field_ = std::make_unique<VoxelDistanceField>(world.grid, VoxelDistanceField::Solid::kOccupied);
    auto voxels = solid_voxels(*field_, clearance_m_, world.start);
    ASSERT_TRUE(voxels);
    region_ = std::make_unique<SpaceRegion>(*field_, clearance_m_, std::move(*voxels));
  }

  std::vector<SpacePath> find(double longest_ratio = 1.5, int classes = 8, int samples = 300,
                              std::uint64_t seed = 1) const {
    return find_space_paths(*field_, *region_, world_.start, world_.goal,
                            {{clearance_m_, 0.0}, classes, longest_ratio, {samples, seed, 10.0}},
                            kGoOn);
  }

  /// All paths keep the clearance, are of pairwise different classes, and shortest first.
  void expect_sound(const std::vector<SpacePath>& paths) const {
    std::set<Signature> signatures;
    double last_m = 0.0;
    for (const SpacePath& path : paths) {
      EXPECT_TRUE(signatures.insert(path.signature).second);
      EXPECT_GE(path.length_m, last_m);
      last_m = path.length_m;
      EXPECT_EQ(path.points.front(), world_.start);
      EXPECT_EQ(path.points.back(), world_.goal);
      for (std::size_t i = 1; i < path.points.size(); ++i) {
        for (double share = 0.0; share <= 1.0; share += 0.02) {
          EXPECT_GE(field_->distance_bound(path.points[i - 1] +
                                           share * (path.points[i] - path.points[i - 1])),
                    clearance_m_ - 1e-9);
        }
      }
    }
  }

  double clearance_m_ = 0.0;
  SpaceWorld world_;
  std::unique_ptr<VoxelDistanceField> field_;
  std::unique_ptr<SpaceRegion> region_;
};

TEST_F(SpacePathsTest, LeadThroughEitherWindow) {
  use(two_windows(0.1));
  const auto paths = find();
  ASSERT_EQ(paths.size(), 2u);
  expect_sound(paths);
}

TEST_F(SpacePathsTest, LeadThroughARingAndPastIt) {
  use(torus(0.1));
  const auto paths = find();
  ASSERT_EQ(paths.size(), 2u);
  expect_sound(paths);
  EXPECT_NE(paths[0].signature, Signature{0});
  EXPECT_EQ(paths[1].signature, Signature{0});
}

TEST_F(SpacePathsTest, LeadUpEitherStairwellByEitherDoor) {
  use(two_storeys(0.1));
  const auto paths = find();
  EXPECT_EQ(paths.size(), 4u);
  expect_sound(paths);
}

TEST_F(SpacePathsTest, MissNoClassWhateverIsDrawn) {
  use(two_storeys(0.1));
  for (std::uint64_t seed = 2; seed < 8; ++seed) EXPECT_EQ(find(1.5, 8, 100, seed).size(), 4u);
  EXPECT_EQ(find(1.5, 8, 0).size(), 4u);
}

TEST_F(SpacePathsTest, LeadThroughAForestByManyClassesThatAreNearlyAsShort) {
  use(forest(1, 40.0, 60, 1.2, 0.2));
  const auto paths = find();
  ASSERT_EQ(paths.size(), 8u);
  expect_sound(paths);
  EXPECT_LT(paths.back().length_m, 1.05 * (world_.goal - world_.start).norm());
}

TEST_F(SpacePathsTest, OfOneClassIsTheShortest) {
  use(two_storeys(0.1));
  EXPECT_EQ(find(1.5, 1).size(), 1u);
  EXPECT_EQ(find(1.0).size(), 1u);
  EXPECT_GT(find(2.5, 20).size(), 4u);
}

TEST_F(SpacePathsTest, ThereIsNoneThroughAWall) {
  SpaceWorld closed = two_windows(0.1);
  for (int z = 0; z < closed.grid.size.z(); ++z) {
    for (int y = 0; y < closed.grid.size.y(); ++y) closed.grid.at(50, y, z) = VoxelGrid::kOccupied;
  }
  use(closed);
  EXPECT_TRUE(find().empty());
}

TEST_F(SpacePathsTest, ThereIsNoneThroughAGapThatIsTooNarrow) {
  SpaceWorld slit = two_windows(0.1);
  for (int z = 0; z < slit.grid.size.z(); ++z) {
    for (int y = 0; y < slit.grid.size.y(); ++y) {
      if (y < 18 || y > 22) slit.grid.at(50, y, z) = VoxelGrid::kOccupied;
    }
  }
  use(slit);
  EXPECT_TRUE(find().empty());
}

/// Two rooms, and a wall between them with one window of so many cells, off the middle.
SpaceWorld window(int wide, int high, int thick) {
  SpaceWorld world;
  world.grid.size = {50, 31, 27};
  for (int i = 0; i < world.grid.size.prod(); ++i) {
    const int x = i % 50;
    const int y = i / 50 % 31;
    const int z = i / (50 * 31);
    const bool is_in_wall = x >= 25 && x < 25 + thick;
    const bool is_in_window = y >= 9 && y < 9 + wide && z >= 12 && z < 12 + high;
    const bool is_solid = is_in_wall && !is_in_window;
    world.grid.cells.push_back(is_solid ? VoxelGrid::kOccupied : VoxelGrid::kFree);
  }
  world.start = {0.8, 1.0, 1.0};
  world.goal = {4.2, 1.7, 1.5};
  return world;
}

TEST_F(SpacePathsTest, LeadThroughAnyDoorOfFourVoxelsThatIsOneWiderThanNeeded) {
  constexpr double kSpare_m = 0.1;  // a voxel
  for (int wide = 4; wide <= 9; ++wide) {
    for (int high = 4; high <= 9; ++high) {
      for (const int thick : {1, 2, 12}) {
        SCOPED_TRACE(std::to_string(wide) + " " + std::to_string(high) + " " +
                     std::to_string(thick));
        use(window(wide, high, thick), 0.05 * std::min(wide, high) - 0.5 * kSpare_m);
        const auto paths = find(1.5, 1, 0);  // by landmarks alone
        ASSERT_EQ(paths.size(), 1u);
        expect_sound(paths);
      }
    }
  }
}

/// Two rooms, and a tunnel of so many cells across from one to the other with a bend.
SpaceWorld bent_tunnel(int across) {
  SpaceWorld world;
  world.grid.size = {40, 40, 20};
  for (int i = 0; i < world.grid.size.prod(); ++i) {
    const int x = i % 40;
    const int y = i / 40 % 40;
    const int z = i / (40 * 40);
    const bool is_in_room = x < 12 || y > 28;
    const bool is_in_x = y >= 8 && y < 8 + across && x < 25 + across;
    const bool is_in_y = x >= 25 && x < 25 + across && y >= 8;
    const bool is_in_tunnel = (is_in_x || is_in_y) && z >= 7 && z < 7 + across;
    const bool is_wall = x >= 12 && y <= 28;
    const bool is_solid = (is_wall || (x < 14 && y > 24)) && !is_in_tunnel;
    world.grid.cells.push_back(is_solid || !(is_in_room || is_in_tunnel) ? VoxelGrid::kOccupied
                                                                         : VoxelGrid::kFree);
  }
  world.start = {0.6, 1.0, 1.0};
  world.goal = {3.2, 3.4, 1.0};
  return world;
}

TEST_F(SpacePathsTest, LeadAroundTheBendOfATunnelOfSixVoxelsThatIsOneWiderThanNeeded) {
  for (int across = 6; across <= 9; ++across) {
    SCOPED_TRACE(across);
    use(bent_tunnel(across), 0.05 * across - 0.05);
    const auto paths = find(1.5, 1, 0);
    EXPECT_EQ(paths.size(), 1u);
    expect_sound(paths);
  }
}

}  // namespace
}  // namespace mocha
