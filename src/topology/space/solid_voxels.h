#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "world/distances/voxel_distance_field.h"

namespace mocha {

/// A map in space as topology sees it: voxels are solid, or can be reached. Whatever is outside is
/// solid. One layer of voxels around the map is kept as well, so that all neighbours of a voxel of
/// the map have a number.
struct SolidVoxels {
  double resolution_m = 0.0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< lowest corner of the map [m]
  Eigen::Vector3i size = Eigen::Vector3i::Zero();    ///< of the map
  std::vector<std::uint8_t> solid;  ///< by number: 1 where it is solid, 0 where it can be reached
  std::vector<float> distance_m;    ///< by number: of the centre to the next obstacle, signed

  Eigen::Vector3i steps() const { return {1, size.x() + 2, (size.x() + 2) * (size.y() + 2)}; }
  int number(const Eigen::Vector3i& voxel) const {
    return (voxel.array() + 1).matrix().dot(steps());
  }
  Eigen::Vector3i voxel(int number) const {
    const Eigen::Vector3i step = steps();
    return Eigen::Vector3i(number % step.y(), number % step.z() / step.y(), number / step.z())
               .array() -
           1;
  }
  bool contains(const Eigen::Vector3i& voxel) const {
    return (voxel.array() >= 0).all() && (voxel.array() < size.array()).all();
  }
  Eigen::Vector3i voxel_at(const Eigen::Vector3d& p) const {
    return ((p - origin) / resolution_m).array().floor().matrix().cast<int>();
  }
  Eigen::Vector3d centre(const Eigen::Vector3i& voxel) const {
    return origin + resolution_m * (voxel.cast<double>().array() + 0.5).matrix();
  }
};

/// Returns what a point that keeps `clearance_m` >= 0 to all obstacles can reach from `seed`;
/// nothing where the seed itself does not keep it. The seed has to be in the field's bounds.
///
/// A voxel is solid if no place in it is proved to keep the clearance, or if it cannot be reached:
/// so no allowed path meets a solid voxel, and allowed paths do not tell whether what can be
/// reached is a little larger than that. Throws std::length_error for maps of more than 2^31
/// voxels.
std::optional<SolidVoxels> solid_voxels(const VoxelDistanceField& field, double clearance_m,
                                        const Eigen::Vector3d& seed);

}  // namespace mocha
