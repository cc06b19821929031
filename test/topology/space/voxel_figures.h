#pragma once

#include <functional>

#include "topology/space/solid_voxels.h"

namespace mocha {

/// Solid where `is_solid` says so of a voxel, all else is open; what is solid is the deeper the
/// farther from the next open voxel.
inline SolidVoxels voxel_figure(const Eigen::Vector3i& size,
                                const std::function<bool(const Eigen::Vector3i&)>& is_solid) {
  SolidVoxels voxels;
  voxels.resolution_m = 1.0;
  voxels.size = size;
  const auto count = static_cast<std::size_t>((size.array() + 2).prod());
  voxels.solid.assign(count, 1);
  voxels.distance_m.assign(count, 0.0f);
  for (int number = 0; number < static_cast<int>(count); ++number) {
    const Eigen::Vector3i voxel = voxels.voxel(number);
    if (voxels.contains(voxel)) voxels.solid[number] = is_solid(voxel) ? 1 : 0;
  }
  return voxels;
}

inline int count_solid(const SolidVoxels& voxels) {
  int count = 0;
  for (int number = 0; number < static_cast<int>(voxels.solid.size()); ++number)
    count += voxels.contains(voxels.voxel(number)) && voxels.solid[number] == 1;
  return count;
}

/// Whether a voxel of a figure of n^3 voxels is in a ring of that radius about the middle, lying
/// across x.
inline bool in_ring(const Eigen::Vector3i& voxel, int n, double radius, double thickness) {
  const Eigen::Vector3d from = voxel.cast<double>() - Eigen::Vector3d::Constant(0.5 * (n - 1));
  return std::hypot(from.x(), std::hypot(from.y(), from.z()) - radius) <= thickness;
}

}  // namespace mocha
