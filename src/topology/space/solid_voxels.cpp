#include "topology/space/solid_voxels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

constexpr std::uint8_t kOpen = 2;  // not solid, not reached yet

/// Marks as reached what is linked to the seed face to face, and all else that is open as solid.
void reach_from(int seed, SolidVoxels& voxels) {
  const Eigen::Vector3i steps = voxels.steps();
  std::vector<int> todo = {seed};
  voxels.solid[seed] = 0;
  while (!todo.empty()) {
    const int number = todo.back();
    todo.pop_back();
    for (const int step : {steps.x(), steps.y(), steps.z()}) {
      for (const int next : {number - step, number + step}) {
        if (voxels.solid[next] != kOpen) continue;
        voxels.solid[next] = 0;
        todo.push_back(next);
      }
    }
  }
  for (std::uint8_t& solid : voxels.solid) solid = solid == 0 ? 0 : 1;
}

}  // namespace

std::optional<SolidVoxels> solid_voxels(const VoxelDistanceField& field, double clearance_m,
                                        const Eigen::Vector3d& seed) {
  SolidVoxels voxels;
  voxels.resolution_m = field.resolution_m();
  voxels.origin = field.bounds().min();
  voxels.size = field.size();
  const double count = (voxels.size.cast<double>().array() + 2.0).prod();
  if (count > std::numeric_limits<int>::max())
    throw std::length_error("solid_voxels: the map has " + std::to_string(std::llround(count)) +
                            " voxels with its margin, allowed are " +
                            std::to_string(std::numeric_limits<int>::max()));
  voxels.solid.assign(static_cast<std::size_t>(count), 1);
  voxels.distance_m.assign(voxels.solid.size(), 0.0f);
  // Every place of a voxel is that close to one of its corners.
  const double open_m = std::max(0.0, clearance_m - kCubeHalfDiagonal * voxels.resolution_m);
  Eigen::Vector3i at;
  for (at.z() = 0; at.z() < voxels.size.z(); ++at.z()) {
    for (at.y() = 0; at.y() < voxels.size.y(); ++at.y()) {
      for (at.x() = 0; at.x() < voxels.size.x(); ++at.x()) {
        const int number = voxels.number(at);
        const auto distances = field.of_cell(at);
        voxels.distance_m[number] = static_cast<float>(distances.mean_m);
        if (distances.largest_m > open_m) voxels.solid[number] = kOpen;
      }
    }
  }
  const Eigen::Vector3i first = voxels.voxel_at(seed);
  if (!voxels.contains(first) || voxels.solid[voxels.number(first)] != kOpen) return std::nullopt;
  reach_from(voxels.number(first), voxels);
  return voxels;
}

}  // namespace mocha
