#pragma once

#include <cmath>
#include <functional>
#include <vector>

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

/// How many parts hang together, of those that are solid (over corners) or open (over faces).
inline int parts(const SolidVoxels& voxels, std::uint8_t kind) {
  std::vector<std::uint8_t> seen(voxels.solid.size(), 0);
  const Eigen::Vector3i steps = voxels.steps();
  int count = 0;
  for (int first = 0; first < static_cast<int>(seen.size()); ++first) {
    if (voxels.solid[first] != kind || seen[first] != 0 || !voxels.contains(voxels.voxel(first)))
      continue;
    ++count;
    std::vector<int> todo = {first};
    seen[first] = 1;
    while (!todo.empty()) {
      const int number = todo.back();
      todo.pop_back();
      for (int i = 0; i < 27; ++i) {
        const Eigen::Vector3i away(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (kind == 0 && away.cwiseAbs().sum() != 1) continue;
        const int next = number + away.dot(steps);
        if (voxels.solid[next] != kind || seen[next] != 0 || !voxels.contains(voxels.voxel(next)))
          continue;
        seen[next] = 1;
        todo.push_back(next);
      }
    }
  }
  return count;
}

/// Vertices less edges plus faces less cubes of the closed solid voxels of the map: the number of
/// parts, less that of tunnels, plus that of cavities.
inline int euler_number(const SolidVoxels& voxels) {
  int sum = 0;
  const Eigen::Vector3i& size = voxels.size;
  // A cell of the complex is at doubled coordinates; odd ones are those along which it extends.
  for (int z = 0; z <= 2 * size.z(); ++z) {
    for (int y = 0; y <= 2 * size.y(); ++y) {
      for (int x = 0; x <= 2 * size.x(); ++x) {
        const Eigen::Vector3i cell(x, y, z);
        const Eigen::Vector3i odd(x % 2, y % 2, z % 2);
        bool is_in = false;
        for (int corner = 0; corner < 8; ++corner) {
          const Eigen::Vector3i side(corner & 1, corner >> 1 & 1, corner >> 2);
          const Eigen::Vector3i voxel =
              (cell.array() / 2 - (1 - odd.array()) * side.array()).matrix();
          is_in = is_in || (voxels.contains(voxel) && voxels.solid[voxels.number(voxel)] == 1);
        }
        if (is_in) sum += odd.sum() % 2 == 0 ? 1 : -1;
      }
    }
  }
  return sum;
}

}  // namespace mocha
