#pragma once

#include <vector>

#include "topology/travel_cost.h"

namespace mocha {

struct GridPath {
  enum class Outcome { kFound, kStartBlocked, kGoalBlocked, kNoPath };
  Outcome outcome = Outcome::kNoPath;
  std::vector<Vector2> points;  ///< from start to goal, straight between; empty unless found
};

/// The cheapest path of the robot's centre from start to goal on a lattice over the terrain's
/// bounds (A*), `step_m` apart but never finer than the terrain's detail: complete to within the
/// lattice, whatever the obstacles. Start and goal must lie inside the bounds, else they count as
/// blocked.
GridPath find_grid_path(const Terrain& terrain, const Vector2& start, const Vector2& goal,
                        const TravelCost& cost, double step_m);

}  // namespace mocha
