#include "topology/space/voxel_thinning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "topology/space/voxel_figures.h"

namespace mocha {
namespace {

using Eigen::Vector3i;

TEST(VoxelThinning, LeavesOneVoxelOfABodyAndOneRingOfARing) {
  constexpr int kSize = 25;
  SolidVoxels ball = voxel_figure(Vector3i::Constant(kSize), [](const Vector3i& voxel) {
    return (voxel - Vector3i::Constant(12)).norm() < 8.0;
  });
  thin_solid(ball);
  EXPECT_EQ(count_solid(ball), 1);
  SolidVoxels ring = voxel_figure(Vector3i::Constant(kSize), [](const Vector3i& voxel) {
    return in_ring(voxel, kSize, 7.0, 2.5);
  });
  thin_solid(ring);
  EXPECT_GT(count_solid(ring), 20);
  EXPECT_LT(count_solid(ring), 60);
  for (int number = 0; number < static_cast<int>(ring.solid.size()); ++number) {
    if (ring.solid[number] == 0 || !ring.contains(ring.voxel(number))) continue;
    EXPECT_EQ(kind_of(ring, number).solid_parts, 2);
    EXPECT_EQ(kind_of(ring, number).open_parts, 1);
  }
}

TEST(VoxelThinning, ChangesNoPartTunnelOrCavity) {
  std::mt19937 random(1);
  for (int run = 0; run < 60; ++run) {
    const Vector3i size(9, 8, 7);
    std::bernoulli_distribution is_solid(0.1 + 0.012 * run);
    // Kept off the rim, beyond which all is solid, so that what is in the map can be told alone.
    const SolidVoxels before = voxel_figure(size, [&](const Vector3i& voxel) {
      const bool is_inner = (voxel.array() > 0).all() && (voxel.array() < size.array() - 1).all();
      return is_solid(random) && is_inner;
    });
    SolidVoxels solid = before;
    thin_solid(solid);
    SolidVoxels open = before;
    thin_open(open);
    ASSERT_LE(count_solid(solid), count_solid(before));
    ASSERT_GE(count_solid(open), count_solid(before));
    EXPECT_EQ(parts(solid, 1), parts(before, 1)) << run;
    EXPECT_EQ(parts(solid, 0), parts(before, 0)) << run;
    EXPECT_EQ(euler_number(solid), euler_number(before)) << run;
    EXPECT_EQ(parts(open, 0), parts(before, 0)) << run;
    EXPECT_EQ(parts(open, 1), parts(before, 1)) << run;
    EXPECT_EQ(euler_number(open), euler_number(before)) << run;
    for (int number = 0; number < static_cast<int>(solid.solid.size()); ++number) {
      if (!solid.contains(solid.voxel(number)) || solid.solid[number] == 0) continue;
      ASSERT_FALSE(kind_of(solid, number).is_simple()) << run;
    }
  }
}

TEST(VoxelThinning, KeepsTheMiddleOfHallsAndTheWayBetween) {
  // Two halls that are joined by a door of one voxel.
  SolidVoxels voxels = voxel_figure({21, 9, 9}, [](const Vector3i& voxel) {
    return voxel.x() == 10 && !(voxel.y() == 4 && voxel.z() == 4);
  });
  for (int number = 0; number < static_cast<int>(voxels.solid.size()); ++number) {
    const Vector3i voxel = voxels.voxel(number);
    if (!voxels.contains(voxel)) continue;
    const int to_wall = std::abs(voxel.x() - 10);
    voxels.distance_m[number] =
        static_cast<float>(std::min({to_wall, voxel.x() + 1, 21 - voxel.x(), voxel.y() + 1,
                                     9 - voxel.y(), voxel.z() + 1, 9 - voxel.z()}));
  }
  thin_open(voxels);
  EXPECT_EQ(voxels.solid[voxels.number({10, 4, 4})], 0);
  EXPECT_EQ(voxels.solid[voxels.number({5, 4, 4})], 0);
  EXPECT_EQ(voxels.solid[voxels.number({15, 4, 4})], 0);
  EXPECT_EQ(parts(voxels, 0), 1);
}

}  // namespace
}  // namespace mocha
