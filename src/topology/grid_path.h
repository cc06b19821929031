#pragma once

#include <vector>

#include "world/distance_field.h"

namespace mocha {

/// How a front-end path is searched on a map.
struct GridPathRules {
  double required_clearance_m = 0.3;   ///< of the robot's centre; closer is forbidden
  double preferred_clearance_m = 0.6;  ///< closer than this costs more
  double clearance_weight = 3.0;       ///< relative extra cost at zero distance
  double step_m = 0.05;                ///< spacing of the search lattice; never finer than the map
  double escape_radius_m =
      0.6;  ///< around the start, places that are no closer than the start itself are allowed
};

/// A disc that must not be entered by the robot's centre, such as a standing team-mate with its
/// margins.
struct BlockedDisc {
  Vector2 centre;
  double radius_m;
};

struct GridPath {
  enum class Outcome { kFound, kStartBlocked, kGoalBlocked, kNoPath };
  Outcome outcome = Outcome::kNoPath;
  std::vector<Vector2> points;  ///< from start to goal, straight between; empty unless found
  double cost = 0.0;            ///< [m], lengthened where clearance is short
};

/// The cheapest path of the robot's centre from start to goal on the lattice of the field's corners
/// (A*), with corners cut where the straight way is no dearer. Start and goal must lie inside the
/// field's rectangle, else they count as blocked.
GridPath find_grid_path(const DistanceField& field, const Vector2& start, const Vector2& goal,
                        const std::vector<BlockedDisc>& blocked, const GridPathRules& rules);

}  // namespace mocha
