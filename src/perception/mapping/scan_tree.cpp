#include "perception/mapping/scan_tree.h"

namespace mocha {

octomap::OcTreeKey key_of(const VoxelIndex& voxel) {
  return {static_cast<octomap::key_type>(voxel[0] + kKeyOrigin),
          static_cast<octomap::key_type>(voxel[1] + kKeyOrigin),
          static_cast<octomap::key_type>(voxel[2] + kKeyOrigin)};
}

unsigned ScanTree::shared_depth(const octomap::OcTreeKey& key) const {
  const unsigned differs = (key[0] ^ last_[0]) | (key[1] ^ last_[1]) | (key[2] ^ last_[2]);
  unsigned depth = kDepth;
  while (differs >> (kDepth - depth) != 0) --depth;
  return depth;
}

octomap::OcTreeNode* ScanTree::leaf(const octomap::OcTreeKey& key) {
  bool fresh =
      root == nullptr;  // made just now; others without children stand for all their voxels
  if (fresh) {
    root = new octomap::OcTreeNode();
    ++tree_size;
  }
  const bool first = way_[0] == nullptr;
  unsigned depth = first ? 0 : shared_depth(key);
  if (first) way_[0] = root;
  last_ = key;
  for (; depth < kDepth; ++depth) {
    octomap::OcTreeNode* node = way_[depth];
    const unsigned i = octomap::computeChildIdx(key, static_cast<int>(kDepth - 1 - depth));
    if (!nodeChildExists(node, i)) {
      if (!fresh && !nodeHasChildren(node)) {
        expandNode(node);
      } else {
        createNodeChild(node, i);
        fresh = true;
      }
    }
    way_[depth + 1] = getNodeChild(node, i);
  }
  return way_[kDepth];
}

}  // namespace mocha
