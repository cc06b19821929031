#include "topology/space/voxel_thinning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "topology/space/voxel_figures.h"

namespace mocha {
namespace {

using Eigen::Vector3i;

/// How many parts hang together, of those that are solid (over corners) or open (over faces).
int parts(const SolidVoxels& voxels, std::uint8_t kind) {
  std::vector<std::uint8_t> seen(voxels.solid.size(), 0);
  const Vector3i steps = voxels.steps();
  int count = 0;
  for (int first = 0; first < static_cast<int>(seen.size()); ++first) {
    if (voxels.solid[first] != kind || seen[first] != 0 || !voxels.contains(voxels.voxel(first)))
      continue;
    ++count;
    std::vector<int> todo = {first};
    seen[first] = 1;
    while (!todo.empty()) {
      const int number = todo.back();
      todo.pop_back();
      for (int i = 0; i < 27; ++i) {
        const Vector3i away(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (kind == 0 && away.cwiseAbs().sum() != 1) continue;
        const int next = number + away.dot(steps);
        if (voxels.solid[next] != kind || seen[next] != 0 || !voxels.contains(voxels.voxel(next)))
          continue;
        seen[next] = 1;
        todo.push_back(next);
      }
    }
  }
  return count;
}

/// Vertices less edges plus faces less cubes of the closed solid voxels of the map: the number of
/// parts, less that of tunnels, plus that of cavities.
int euler_number(const SolidVoxels& voxels) {
  int sum = 0;
  const Vector3i& size = voxels.size;
  // A cell of the complex is at doubled coordinates; odd ones are those along which it extends.
  for (int z = 0; z <= 2 * size.z(); ++z) {
    for (int y = 0; y <= 2 * size.y(); ++y) {
      for (int x = 0; x <= 2 * size.x(); ++x) {
        const Vector3i cell(x, y, z);
        const Vector3i odd(x % 2, y % 2, z % 2);
        bool is_in = false;
        for (int corner = 0; corner < 8; ++corner) {
          const Vector3i side(corner & 1, corner >> 1 & 1, corner >> 2);
          const Vector3i voxel = (cell.array() / 2 - (1 - odd.array()) * side.array()).matrix();
          is_in = is_in || (voxels.contains(voxel) && voxels.solid[voxels.number(voxel)] == 1);
        }
        if (is_in) sum += odd.sum() % 2 == 0 ? 1 : -1;
      }
    }
  }
  return sum;
}

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
