#pragma once

#include <octomap/OcTree.h>

#include <array>

#include "perception/mapping/beam_raster.h"

namespace mocha {

/// OctoMap's key of the voxel [0, resolution).
constexpr int kKeyOrigin = 32768;

octomap::OcTreeKey key_of(const VoxelIndex& voxel);

/// An OcTree that remembers the way to the last leaf: neighbours share most of it, so a scan costs
/// little more than its cells.
class ScanTree : public octomap::OcTree {
 public:
  static constexpr unsigned kDepth = 16;

  explicit ScanTree(double resolution_m) : OcTree(resolution_m) {}

  /// The voxel's node at the lowest level, made (with log-odds 0) if need be. Inner nodes are out
  /// of date until updateInnerOccupancy(). Nothing may be pruned or deleted between calls.
  octomap::OcTreeNode* leaf(const octomap::OcTreeKey& key);

 private:
  unsigned shared_depth(const octomap::OcTreeKey& key) const;

  octomap::OcTreeKey last_;
  std::array<octomap::OcTreeNode*, kDepth + 1> way_{};
};

}  // namespace mocha
