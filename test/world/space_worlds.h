#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "world/voxel_grid.h"

namespace mocha {

/// A map in space, and from where to where one goes in it.
struct SpaceWorld {
  VoxelGrid grid;
  Eigen::Vector3d start;
  Eigen::Vector3d goal;
};

/// `is_solid` is asked of the centre of each cell.
inline VoxelGrid voxel_grid(const Eigen::Vector3d& size_m, double resolution_m,
                            const std::function<bool(const Eigen::Vector3d&)>& is_solid) {
  VoxelGrid grid;
  grid.resolution_m = resolution_m;
  grid.size = (size_m / resolution_m).array().round().matrix().cast<int>();
  grid.cells.resize(static_cast<std::size_t>(grid.size.cast<double>().prod()));
  for (int z = 0; z < grid.size.z(); ++z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      for (int x = 0; x < grid.size.x(); ++x) {
        grid.at(x, y, z) =
            is_solid(grid.cell_centre(x, y, z)) ? VoxelGrid::kOccupied : VoxelGrid::kFree;
      }
    }
  }
  return grid;
}

inline bool is_within(const Eigen::Vector3d& p, const Eigen::Vector3d& low,
                      const Eigen::Vector3d& high) {
  return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
}

/// Upright trunks from the ground to the canopy, at least `gap_m` apart.
inline SpaceWorld forest(int seed, double side_m, int trunks, double gap_m, double resolution_m) {
  constexpr double kHeight_m = 6.0;
  struct Trunk {
    Eigen::Vector2d foot;
    double radius_m;
  };
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const Eigen::Vector2d start(1.5, 1.5);
  const Eigen::Vector2d goal(side_m - 1.5, side_m - 1.5);
  std::vector<Trunk> planted;
  for (int attempt = 0; attempt < 100000 && static_cast<int>(planted.size()) < trunks; ++attempt) {
    const Trunk trunk{{uniform(1.0, side_m - 1.0), uniform(1.0, side_m - 1.0)}, uniform(0.2, 0.6)};
    bool is_apart = (trunk.foot - start).norm() > 1.5 && (trunk.foot - goal).norm() > 1.5;
    for (const Trunk& other : planted) {
      is_apart =
          is_apart && (other.foot - trunk.foot).norm() > other.radius_m + trunk.radius_m + gap_m;
    }
    if (is_apart) planted.push_back(trunk);
  }
  const auto is_solid = [&](const Eigen::Vector3d& p) {
    for (const Trunk& trunk : planted) {
      if ((p.head<2>() - trunk.foot).norm() <= trunk.radius_m) return true;
    }
    return false;
  };
  return {voxel_grid({side_m, side_m, kHeight_m}, resolution_m, is_solid),
          {start.x(), start.y(), 1.5},
          {goal.x(), goal.y(), 4.5}};
}

/// A hall of 10 m, divided by a wall with two windows of 1.6 m at different heights.
inline SpaceWorld two_windows(double resolution_m) {
  const auto is_solid = [](const Eigen::Vector3d& p) {
    if (std::abs(p.x() - 5.0) > 0.15) return false;
    return !is_within(p, {0.0, 1.2, 1.0}, {10.0, 2.8, 2.6}) &&
           !is_within(p, {0.0, 5.4, 2.2}, {10.0, 7.0, 3.8});
  };
  return {voxel_grid({10.0, 8.0, 5.0}, resolution_m, is_solid), {1.0, 4.0, 1.5}, {9.0, 4.0, 1.5}};
}

/// A ring that hangs free across the way.
inline SpaceWorld torus(double resolution_m) {
  const auto is_solid = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d from = p - Eigen::Vector3d(5.0, 5.0, 4.0);
    return std::hypot(from.x(), std::hypot(from.y(), from.z()) - 1.8) <= 0.4;
  };
  return {voxel_grid({10.0, 10.0, 8.0}, resolution_m, is_solid), {1.0, 5.0, 4.0}, {9.0, 5.5, 4.0}};
}

/// Two storeys of 12 m x 10 m x 2.8 m: each of two rooms that are joined by two doors, with an open
/// stairwell from one storey to the other at either end.
inline SpaceWorld two_storeys(double resolution_m) {
  const auto is_solid = [](const Eigen::Vector3d& p) {
    const bool is_in_floor = std::abs(p.z() - 3.0) <= 0.15;
    const bool is_in_well = is_within(p, {0.8, 7.2, 0.0}, {2.6, 9.2, 6.0}) ||
                            is_within(p, {9.4, 0.8, 0.0}, {11.2, 2.8, 6.0});
    if (is_in_floor) return !is_in_well;
    if (std::abs(p.x() - 6.0) > 0.15) return false;
    const double height_m = p.z() < 3.0 ? p.z() : p.z() - 3.15;
    const bool is_in_door =
        height_m <= 2.0 && (std::abs(p.y() - 2.0) <= 0.5 || std::abs(p.y() - 7.5) <= 0.5);
    return !is_in_door;
  };
  return {voxel_grid({12.0, 10.0, 6.0}, resolution_m, is_solid), {2.0, 2.0, 1.2}, {10.0, 8.0, 4.4}};
}

/// By their names.
inline std::vector<std::pair<std::string, SpaceWorld>> space_worlds() {
  constexpr double kFine_m = 0.1;
  return {{"forest", forest(1, 40.0, 60, 1.2, 0.2)},
          {"two_windows", two_windows(kFine_m)},
          {"torus", torus(kFine_m)},
          {"two_storeys", two_storeys(kFine_m)}};
}

}  // namespace mocha
