#pragma once

#include <functional>
#include <vector>

#include "topology/static_map/travel_cost.h"

namespace mocha {

/// Apart are the places of the lattice on which robots look for paths [m].
inline constexpr double kLatticeStep_m = 0.05;

struct GridPath {
  enum class Outcome { kFound, kStartBlocked, kGoalBlocked, kNoPath, kStopped };
  Outcome outcome = Outcome::kNoPath;
  std::vector<Vector2> points;  ///< from start to goal, straight between; empty unless found
};

/// The cheapest path of the robot's centre from start to goal on a lattice over the static map's
/// bounds (A*), `step_m` apart but never finer than the static map's detail: complete to within the
/// lattice, whatever the obstacles. Start and goal must lie inside the bounds, else they count as
/// blocked. `should_stop` ends the search early.
GridPath find_grid_path(
    const StaticMap& static_map, const Vector2& start, const Vector2& goal, const TravelCost& cost,
    double step_m, const std::function<bool()>& should_stop = [] { return false; });

/// The same to that one of the places on the lattice for which `suits` holds to which the way is
/// cheapest, no dearer than `most_m`. They are asked in this order, `start` first.
GridPath find_nearest_place(const StaticMap& static_map, const Vector2& start,
                            const TravelCost& cost, double step_m, double most_m,
                            const std::function<bool(const Vector2&)>& suits);

}  // namespace mocha
