#pragma once

#include <vector>

#include "world/corner_window.h"
#include "world/obstacle_field.h"
#include "world/occupancy_grid.h"

namespace mocha {

class DistanceRepair;

/// Exact Euclidean distances to the solid cells of a map.
///
/// Distances are kept at the corners of the cells. There, the distance to the union of the closed
/// solid squares equals the distance to the nearest corner of a solid square, so the transform of
/// the corner lattice is exact: no error of half a cell as with centres. Between the corners,
/// distance_bound() uses that d(p)^2 - |p|^2 is concave, being a minimum of linear functions of p:
/// the interpolated squared distance, less how far |p|^2 sags below its own interpolation, is a
/// lower bound. Beside one obstacle it is closer than a millimetre at the distances and cells of
/// small robots; midway between several it falls short by up to 0.9 cells.
class DistanceField : public ObstacleField<2> {
 public:
  enum class Solid {
    kOccupied,          ///< occupied cells; everything outside the map is open
    kOccupiedOrUnknown  ///< whatever has not been seen free, outside included; 0 inside, for proofs
                        ///< only
  };

  /// Throws std::invalid_argument for an empty grid or sizes that do not match.
  DistanceField(const OccupancyGrid& grid, Solid solid);

  /// Brings it up to date with a map in which only some cells have changed since, all of them in
  /// these windows of cells: as if made anew, at the cost of what is around those. Returns windows
  /// around the corners whose distances differ now, none of them wide. Not while others read it.
  /// Throws std::invalid_argument for a map of another size or place.
  std::vector<CornerWindow> repair(const OccupancyGrid& grid,
                                   const std::vector<CornerWindow>& cells);

  Sample sample(const Vector2& p) const override;
  double distance_bound(const Vector2& p) const override;
  double room(const Vector& p, double radius_m) const override;
  bool clear(const Box& box, double radius_m) const override;

  double resolution_m() const { return resolution_m_; }
  const Vector2& origin() const { return origin_; }
  int columns() const { return columns_; }  ///< corners along x: cells + 1
  int rows() const { return rows_; }
  CornerWindow corners() const { return {0, 0, columns_ - 1, rows_ - 1}; }
  /// Signed distance [m] at a corner of the lattice.
  double at_corner(int x, int y) const {
    return distance_m_[static_cast<std::size_t>(y) * columns_ + x];
  }
  Vector2 corner(int x, int y) const { return origin_ + resolution_m_ * Vector2(x, y); }

 private:
  // Places in cells from the origin: whether one is inside the lattice, and what is there if so.
  bool is_inside(const Vector2& at) const {
    return at.x() >= 0.0 && at.x() <= columns_ - 1.0 && at.y() >= 0.0 && at.y() <= rows_ - 1.0;
  }
  Sample interpolated(const Vector2& at) const;
  double bound_inside(const Vector2& at) const;
  Solid solid() const { return outside_solid_ ? Solid::kOccupiedOrUnknown : Solid::kOccupied; }
  bool repair_sites(const OccupancyGrid& grid, const CornerWindow& changed,
                    std::vector<DistanceRepair>& sides);
  void make_anew(const OccupancyGrid& grid, const CornerWindow& changed,
                 std::vector<CornerWindow>& differ);
  CornerWindow reach_of(const CornerWindow& changed) const;
  template <typename Visit>
  void visit_rim(const CornerWindow& window, const Visit& visit) const;
  CornerWindow take_over(const std::vector<float>& made, const CornerWindow& sources,
                         const CornerWindow& part);

  double resolution_m_;
  double cells_per_m_;
  Vector2 origin_;
  int columns_;
  int rows_;
  bool outside_solid_;
  std::vector<float> distance_m_;  // signed
};

}  // namespace mocha
