#pragma once

#include <cstdint>
#include <vector>

#include "topology/space/solid_voxels.h"

namespace mocha {

/// A voxel among its 26 neighbours, of which the solid ones hang together over corners and the open
/// ones over faces (Bertrand and Malandain 1994).
struct VoxelKind {
  int solid_parts;  ///< of the solid neighbours
  int open_parts;   ///< of the open ones around the voxel that touch one of its faces
  /// Whether it may change from solid to open, or back, and no part, tunnel or cavity comes or
  /// goes.
  bool is_simple() const { return solid_parts == 1 && open_parts == 1; }
};

/// Of a voxel of the map.
VoxelKind kind_of(const SolidVoxels& voxels, int number);

/// Makes as few voxels of the map solid as can be while parts, tunnels and cavities stay what they
/// are: what is left is curves about which one can go, single voxels for what is solid all through,
/// and surfaces about what is hollow. What is next to the open goes first, so that curves run
/// through the middle. Homotopic thinning in the order of distance (Pudney 1998).
void thin_solid(SolidVoxels& voxels);

/// The same with solid and open exchanged: the open voxels that are left are the ways through the
/// map, in the middle between all obstacles. Voxels with no less room than any neighbour remain, so
/// that the ways lead to the middle of each hall.
void thin_open(SolidVoxels& voxels);

}  // namespace mocha
