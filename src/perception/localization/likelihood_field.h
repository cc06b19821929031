#pragma once

#include <vector>

#include "world/occupancy_grid.h"

namespace mocha {

/// Distances to the centres of a map's occupied cells: what a scan is fitted to. A wall that a
/// lidar has mapped is one or two cells thick, and its surface is, in the mean, in their middle;
/// distances to the cells' faces would be short by half a cell.
class LikelihoodField {
 public:
  struct Sample {
    double distance_m;  ///< never negative, interpolated; at most the reach
    Vector2 gradient;
  };

  /// Farther than `reach_m` from any wall the field is flat. Throws std::invalid_argument for an
  /// empty grid, sizes that do not match, and cells or corners that no map of a place has.
  LikelihoodField(const OccupancyGrid& map, double reach_m);

  /// Outside of the map as well: a wall at its rim is met a little behind it, too.
  Sample sample(const Vector2& p) const;

  /// What the map says of a point: OccupancyGrid::kUnknown outside.
  int8_t cell(const Vector2& p) const;

  /// With unknown cells around it, as far as walls reach.
  const OccupancyGrid& map() const { return map_; }

 private:
  float at_centre(int x, int y) const {
    return distance_m_[static_cast<std::size_t>(y) * map_.width + x];
  }

  OccupancyGrid map_;
  double reach_m_;
  std::vector<float> distance_m_;
};

}  // namespace mocha
