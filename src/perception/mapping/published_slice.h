#pragma once

#include <utility>
#include <vector>

#include "perception/mapping/occupancy_map.h"
#include "perception/mapping/zone_exit.h"
#include "world/corner_window.h"
#include "world/obstacle.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// The slice of a map as others have it, with zones that are not to be entered: kept, and brought
/// up to date where the map has changed.
class PublishedSlice {
 public:
  struct Change {
    bool whole;                         ///< another place, size, or map altogether
    std::vector<CornerWindow> windows;  ///< else: cells of the grid, both ends included
  };

  /// From the next update on, these areas look occupied, seen or not, but for an open strip.
  void mark(std::vector<Polygon> keep_out, Strip open = {});

  /// At least `border_m` of unknown cells are around what is known. The grid grows by more than it
  /// must, so that a map that is being made does not change its size with every scan.
  Change update(OccupancyMap& map, double border_m);

  /// Whether areas are marked or opened that the grid does not show yet.
  bool marks_changed() const { return marks_changed_; }
  const OccupancyGrid& grid() const { return grid_; }

 private:
  struct Run {  // of cells of a zone, by their indices in the map
    int y, x0, x1;
  };

  void lay_out(const OccupancyMap& map, const CornerWindow& cells);
  void find_zones(double resolution_m);
  void copy(const OccupancyMap& map, const CornerWindow& cells);

  std::vector<Polygon> keep_out_;
  Strip open_;
  bool marks_changed_ = false;
  std::vector<Run> zones_;
  CornerWindow zones_around_{0, 0, -1, -1};
  OccupancyGrid grid_;
  CornerWindow cells_{0, 0, -1, -1};  // those of the map that the grid holds
  int replaced_ = -1;                 // of the map that it was made of
  bool knew_nothing_ = true;          // that map: its place was no place
};

}  // namespace mocha
