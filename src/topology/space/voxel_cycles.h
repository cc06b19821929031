#pragma once

#include <vector>

#include "topology/space/solid_voxels.h"

namespace mocha {

/// Voxels by their numbers, each a neighbour of the next by a face, an edge or a corner.
struct VoxelChain {
  std::vector<int> voxels;
  /// The last is a neighbour of the first. Otherwise both ends are next to what is outside of the
  /// map, and the chain is closed through there.
  bool is_closed;
};

/// What has been thinned to curves, as a basis of its closed chains: each way around solid matter
/// is a sum of some of them, and none of them is a sum of others.
struct VoxelCycles {
  std::vector<VoxelChain> chains;
  int bodies = 0;          ///< single voxels: what is passed on either side alike
  int surface_voxels = 0;  ///< voxels that thinning left on surfaces
};

/// Of the solid voxels inside of the map, after thin_solid().
VoxelCycles voxel_cycles(const SolidVoxels& thinned);

}  // namespace mocha
