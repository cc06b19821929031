#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mocha {

constexpr double kCubeHalfDiagonal = 0.8660254037844387;  ///< of a cube with edges of 1

/// A map of cubic cells in space, layer by layer and row by row from its lowest corner `origin` [m,
/// map frame].
struct VoxelGrid {
  static constexpr std::int8_t kUnknown = -1;
  static constexpr std::int8_t kFree = 0;
  static constexpr std::int8_t kOccupied = 100;

  double resolution_m = 0.1;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  ///< cells along x, y and z
  std::vector<std::int8_t> cells;                  ///< one for each: kUnknown, kFree or kOccupied

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * size.y() + y) * size.x() + x;
  }
  std::int8_t& at(int x, int y, int z) { return cells[index(x, y, z)]; }
  std::int8_t at(int x, int y, int z) const { return cells[index(x, y, z)]; }
  Eigen::Vector3d cell_centre(int x, int y, int z) const {
    return origin + resolution_m * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
  }
};

}  // namespace mocha
