#pragma once

#include <cstddef>
#include <string>

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

/// What stands in an OctoMap file before its nodes.
std::string octree_header(bool binary, std::size_t nodes, double resolution_m);

}  // namespace mocha
