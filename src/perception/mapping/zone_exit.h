#pragma once

#include <vector>

#include "perception/mapping/occupancy_map.h"
#include "world/footprint.h"
#include "world/obstacle.h"

namespace mocha {

/// A strip of ground along a path. Map frame.
struct Strip {
  std::vector<Vector2> path;  ///< empty: none
  double half_width_m = 0.0;

  bool covers(const Vector2& place) const;
};

/// What a robot needs in order to leave.
struct ExitRoom {
  double half_width_m;  ///< of the strip, clear of all areas where it ends
  double body_m;        ///< to occupied cells, if it can be had
  double least_m;       ///< the same, where the robot hardly fits
};

/// A strip along `course`, which the robot takes in any case, and on from its end out of the areas:
/// as short as may be, by cells that are not occupied and, if it can be had, were seen. Where there
/// is no way out, it is the course alone. Nothing that is farther off than 30 m is found.
Strip find_exit(const std::vector<Polygon>& areas, const OccupancyMap& map,
                const std::vector<Vector2>& course, const ExitRoom& room);

}  // namespace mocha
