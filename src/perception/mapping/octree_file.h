#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "perception/mapping/beam_raster.h"

namespace mocha {

/// The parts of an OctoMap file (.ot, or .bt with one bit of occupancy per voxel).
struct OctreeFile {
  bool binary;  ///< .bt
  double resolution_m;
  std::string nodes;  ///< serialised tree; empty for an empty map
};

/// Splits an OctoMap file and proves that its tree is complete and well formed: OctoMap's own
/// readers recurse without limit on damaged ones. Throws MapError naming `path`.
OctreeFile parse_octree_file(const std::string& bytes, const std::string& path);

/// A cube of voxels, `size` along each edge.
struct OctreeLeaf {
  VoxelIndex low;
  int size;
  float log_odds;
};

/// Calls visit for every leaf of a file that was parsed, without building its tree: that would take
/// fifty times the file's size. A .bt file only tells free from occupied: `free` and `occupied` are
/// the log-odds then.
void for_each_leaf(const OctreeFile& file, float free, float occupied,
                   const std::function<void(const OctreeLeaf&)>& visit);

/// What stands in an OctoMap file before its nodes.
std::string octree_header(bool binary, std::size_t nodes, double resolution_m);

}  // namespace mocha
