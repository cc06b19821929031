#include "perception/mapping/voxel_map_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "perception/mapping/column_grid.h"
#include "perception/mapping/map_error.h"
#include "perception/mapping/map_image.h"
#include "perception/mapping/octree_file.h"

namespace mocha {
namespace {

constexpr double kMostGridCells = 100e6;

/// Both corners included.
using Voxels = Eigen::AlignedBox3i;

Voxels voxels_of(const OctreeLeaf& leaf) {
  const Eigen::Vector3i low(leaf.low[0], leaf.low[1], leaf.low[2]);
  return {low, low.array() + leaf.size - 1};
}

Voxels voxels_of(const Eigen::AlignedBox3d& box, double resolution_m, const std::string& path) {
  if (box.isEmpty()) return {};
  const Eigen::AlignedBox3d cells(box.min() / resolution_m, box.max() / resolution_m);
  const auto is_near = [](const Eigen::Vector3d& corner) {
    return (corner.array().abs() < kMostGridCells).all();
  };
  if (!is_near(cells.min()) || !is_near(cells.max()))
    throw MapError(path +
                   ": the box that is wanted of the map has a corner that is more than 100 "
                   "million cells of " +
                   std::to_string(resolution_m) + " m away");
  return {cells.min().array().floor().matrix().cast<int>(),
          cells.max().array().ceil().matrix().cast<int>() - Eigen::Vector3i::Ones()};
}

VoxelGrid empty_grid(const Voxels& voxels, double resolution_m, std::int8_t value,
                     const std::string& path) {
  VoxelGrid grid;
  grid.resolution_m = resolution_m;
  grid.origin = resolution_m * voxels.min().cast<double>();
  grid.size = voxels.sizes().array() + 1;
  const double cells = grid.size.cast<double>().prod();
  if (cells > kMostGridCells)
    throw MapError(path + ": the map has " + std::to_string(static_cast<long>(cells)) +
                   " cells, allowed are 100 million");
  grid.cells.assign(static_cast<std::size_t>(cells), value);
  return grid;
}

}  // namespace

VoxelGrid load_voxel_map(const std::string& path, const MapExtent& extent) {
  const std::string ending = std::filesystem::path(path).extension();
  if (ending != ".bt" && ending != ".ot")
    throw MapError(path + ": the name of a map in space must end in .bt or .ot");
  const OctreeFile file = parse_octree_file(read_file(path), path);
  const auto for_each = [&](const auto& visit) { for_each_leaf(file, -1.0f, 1.0f, visit); };
  Voxels voxels;
  bool has_free = false;
  for_each([&](const OctreeLeaf& leaf) {
    voxels.extend(voxels_of(leaf));
    has_free = has_free || !ColumnGrid::is_occupied(leaf.log_odds);
  });
  if (voxels.isEmpty()) throw MapError(path + ": the map is empty");
  voxels.extend(voxels_of(extent.at_least, file.resolution_m, path));
  if (!extent.exactly.isEmpty()) voxels = voxels_of(extent.exactly, file.resolution_m, path);
  VoxelGrid grid = empty_grid(voxels, file.resolution_m,
                              has_free ? VoxelGrid::kUnknown : VoxelGrid::kFree, path);
  for_each([&](const OctreeLeaf& leaf) {
    const Voxels part = voxels_of(leaf).intersection(voxels).translated(-voxels.min());
    if (part.isEmpty()) return;
    const std::int8_t value =
        ColumnGrid::is_occupied(leaf.log_odds) ? VoxelGrid::kOccupied : VoxelGrid::kFree;
    for (int z = part.min().z(); z <= part.max().z(); ++z) {
      for (int y = part.min().y(); y <= part.max().y(); ++y)
        std::fill_n(&grid.at(part.min().x(), y, z), part.sizes().x() + 1, value);
    }
  });
  return grid;
}

}  // namespace mocha
