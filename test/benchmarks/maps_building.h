#pragma once

#include <optional>
#include <string>

#include "world/occupancy_grid.h"

namespace mocha {

/// A seeded map of a building, with a drive from corner to corner.
struct Building {
  OccupancyGrid grid;  ///< nothing is unknown
  Vector2 start = Vector2::Zero();
  Vector2 goal = Vector2::Zero();
};

/// Cells of 5 cm, `side_m` on each side, at least 30. Names: rooms, corridors, pillars, maze,
/// clutter; nothing for another one.
std::optional<Building> building(const std::string& name, double side_m, unsigned seed);

/// The map with a wall of 0.2 m about a square of 3 m, its middle free.
OccupancyGrid walled_in(const OccupancyGrid& grid, const Vector2& place);

}  // namespace mocha
