#pragma once

#include <vector>

#include "world/obstacle_field.h"
#include "world/voxel_grid.h"

namespace mocha {

/// Exact Euclidean distances to the solid cells of a map in space. Whatever is outside of the map
/// is solid, as it has not been seen.
///
/// As DistanceField has it in the plane, distances are kept at the corners of the cells, where they
/// are exact, and distance_bound() uses that d(p)^2 - |p|^2 is concave in between. At a distance of
/// d from one wall it falls short by up to h^2 / (4 d), where h is the edge of a cell. Midway
/// between walls that are an odd number of cells apart no corner is, so centres of cells are
/// vertices as well: each obstacle is in some octant about a centre, and farther from it than from
/// the corner there, which it keeps its distance to. So five cells and more apart, along a line of
/// centres, it falls short by at most a fifth of a cell, and somewhere else by up to about a cell.
class VoxelDistanceField : public ObstacleField<3> {
 public:
  enum class Solid { kOccupied, kOccupiedOrUnknown };

  /// Throws std::invalid_argument for an empty grid or sizes that do not match.
  VoxelDistanceField(const VoxelGrid& grid, Solid solid);

  Sample sample(const Vector& p) const override;
  double distance_bound(const Vector& p) const override;
  double room(const Vector& p, double radius_m) const override;
  bool clear(const Box& box, double radius_m) const override;

  double resolution_m() const { return resolution_m_; }
  Eigen::Vector3i size() const { return corners_.array() - 1; }  ///< cells along x, y and z
  Box bounds() const { return {origin_, origin_ + resolution_m_ * size().cast<double>()}; }

  /// At the corners of a cell of the map [m], signed.
  struct CellDistances {
    double mean_m;
    double largest_m;
  };
  CellDistances of_cell(const Eigen::Vector3i& cell) const;

  /// The centres of the solid cells that are beside open ones [m], for pictures.
  std::vector<Vector> surface() const;

 private:
  bool is_inside(const Vector& at) const {
    return (at.array() >= 0.0).all() && (at.array() <= corners_.array().cast<double>() - 1.0).all();
  }
  double at_corner(int x, int y, int z) const {
    return distance_m_[(static_cast<std::size_t>(z) * corners_.y() + y) * corners_.x() + x];
  }
  Sample interpolated(const Vector& at) const;
  double squared_at_centre(const Eigen::Vector3i& cell) const;
  double squared_between_centres(const Eigen::Vector3i& cell, const Vector& share) const;

  double resolution_m_;
  double cells_per_m_;
  Vector origin_;
  Eigen::Vector3i corners_;        // along x, y and z: cells + 1
  std::vector<float> distance_m_;  // signed
};

}  // namespace mocha
