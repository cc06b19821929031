#pragma once

#include <utility>
#include <vector>

#include "world/corner_window.h"
#include "world/distances/distance_field.h"

namespace mocha {

/// What stands in one tile of a map: solid matter, and the gaps in it that a robot cannot pass,
/// whose centre keeps a clearance.
struct ObstacleTile {
  /// What hangs together in the tile.
  struct Part {
    int solid_corners = 0;                ///< in it; 0 where all of the part is a gap
    Vector2 sum = Vector2::Zero();        ///< of their places
    Vector2 innermost = Vector2::Zero();  ///< that of them which is nearest to their mean
  };
  std::vector<Part> parts;
  /// Corners on the border, as numbers (y * columns of the field + x), and the part of each: the
  /// neighbours' parts go on there.
  std::vector<std::pair<int, int>> border;
};

ObstacleTile obstacle_tile(const DistanceField& field, const CornerWindow& window,
                           double clearance_m);

}  // namespace mocha
