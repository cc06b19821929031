#pragma once

#include <Eigen/Geometry>
#include <string>

#include "world/voxel_grid.h"

namespace mocha {

/// Which part of space a map is wanted of [m]; rounded to whole cells, outwards.
struct MapExtent {
  Eigen::AlignedBox3d exactly;   ///< if not empty, this box
  Eigen::AlignedBox3d at_least;  ///< else what the map knows of, and this box
};

/// An OctoMap file (.bt or .ot) as a grid. Voxels that the file does not mention are unknown; if it
/// holds no free voxel at all, as one that was made of a drawing, they are free.
///
/// Throws MapError, naming the file, if it cannot be read, is damaged, holds nothing, or if the
/// grid would have more than 100 million cells.
VoxelGrid load_voxel_map(const std::string& path, const MapExtent& extent);

}  // namespace mocha
