#include "topology/space/solid_voxels.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace mocha {
namespace {

constexpr double kHalfDiagonal = 0.8660254037844387;  // of a cube
constexpr std::uint8_t kOpen = 2;                     // not solid, not reached yet

/// The open voxel whose centre is nearest to p, not farther than `radius_m` and two voxels.
std::optional<int> nearest_open(const SolidVoxels& voxels, const Eigen::Vector3d& p,
                                double radius_m) {
  const Eigen::Vector3i around =
      Eigen::Vector3i::Constant(2 + static_cast<int>(radius_m / voxels.resolution_m));
  const Eigen::Vector3i middle = voxels.voxel_at(p);
  const Eigen::Vector3i low = (middle - around).cwiseMax(0);
  const Eigen::Vector3i high = (middle + around).cwiseMin((voxels.size.array() - 1).matrix());
  std::optional<int> nearest;
  double nearest_m = std::numeric_limits<double>::infinity();
  Eigen::Vector3i at;
  for (at.z() = low.z(); at.z() <= high.z(); ++at.z()) {
    for (at.y() = low.y(); at.y() <= high.y(); ++at.y()) {
      for (at.x() = low.x(); at.x() <= high.x(); ++at.x()) {
        const double away_m = (voxels.centre(at) - p).norm();
        if (voxels.solid[voxels.number(at)] != kOpen || away_m >= nearest_m) continue;
        nearest_m = away_m;
        nearest = voxels.number(at);
      }
    }
  }
  return nearest;
}

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
                                        const Eigen::Vector3d& seed, double escape_m) {
  SolidVoxels voxels;
  voxels.resolution_m = field.resolution_m();
  voxels.origin = field.bounds().min();
  voxels.size = field.size();
  const double count = (voxels.size.cast<double>().array() + 2.0).prod();
  if (count > std::numeric_limits<int>::max())
    throw std::length_error("solid_voxels: the map has too many voxels");
  voxels.solid.assign(static_cast<std::size_t>(count), 1);
  voxels.distance_m.assign(voxels.solid.size(), 0.0f);
  // Every place of a voxel is that close to one of its corners.
  const double open_m = std::max(0.0, clearance_m - kHalfDiagonal * voxels.resolution_m);
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
  const auto first = nearest_open(voxels, seed, escape_m);
  if (!first) return std::nullopt;
  reach_from(*first, voxels);
  return voxels;
}

}  // namespace mocha
