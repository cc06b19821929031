#include "benchmarks/built_worlds.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "topology/space/space_paths.h"
#include "world/space_worlds.h"

namespace mocha {
namespace {

constexpr double kScale = 10.0;
constexpr double kVoxel_m = 0.05;    // before it is scaled
constexpr double kFrontEnd_m = 0.8;  // clearance of the paths, which then meet penalties

BenchmarkWorld<3> scaled(SpaceWorld world) {
  world.grid.resolution_m *= kScale;
  world.grid.origin *= kScale;
  const Eigen::Vector3d start = kScale * world.start;
  const Eigen::Vector3d goal = kScale * world.goal;
  const auto field =
      std::make_shared<VoxelDistanceField>(world.grid, VoxelDistanceField::Solid::kOccupied);
  auto voxels = solid_voxels(*field, kFrontEnd_m, start);
  if (!voxels) throw std::runtime_error("built worlds: the start is not free");
  const SpaceRegion region(*field, kFrontEnd_m, std::move(*voxels));
  const std::vector<SpacePath> paths = find_space_paths(
      *field, region, start, goal, {{kFrontEnd_m, 0.0}, 1, 1.0, {1000, 1, 10.0 * kScale}},
      [] { return false; });
  if (paths.empty()) throw std::runtime_error("built worlds: there is no path through");
  return {field, paths.front().points};
}

}  // namespace

std::vector<BenchmarkWorld<3>> built_worlds() {
  return {scaled(two_windows(kVoxel_m)), scaled(torus(kVoxel_m)), scaled(two_storeys(kVoxel_m))};
}

}  // namespace mocha
