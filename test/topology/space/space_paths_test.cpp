#include "topology/space/space_paths.h"

#include <gtest/gtest.h>

#include <set>

#include "world/space_worlds.h"

namespace mocha {
namespace {

using Eigen::Vector3d;

constexpr double kClearance_m = 0.3;
const auto kGoOn = [] { return false; };

class SpacePathsTest : public testing::Test {
 protected:
  void use(const SpaceWorld& world) {
    world_ = world;
    field_ = std::make_unique<VoxelDistanceField>(world.grid, VoxelDistanceField::Solid::kOccupied);
    auto voxels = solid_voxels(*field_, kClearance_m, world.start);
    ASSERT_TRUE(voxels);
    region_ = std::make_unique<SpaceRegion>(*field_, kClearance_m, std::move(*voxels));
  }

  std::vector<SpacePath> find(double longest_ratio = 1.5, int classes = 8, int samples = 300,
                              std::uint64_t seed = 1) const {
    return find_space_paths(*field_, *region_, world_.start, world_.goal,
                            {{kClearance_m, 0.0}, classes, longest_ratio, {samples, seed, 10.0}},
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
                    kClearance_m - 1e-9);
        }
      }
    }
  }

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

}  // namespace
}  // namespace mocha
