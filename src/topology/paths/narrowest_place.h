#pragma once

#include <functional>
#include <optional>

#include "topology/static_map/static_map.h"

namespace mocha {

/// Where a passage is narrowest.
struct NarrowPlace {
  Vector2 place;
  double width_m;  ///< of the passage, on the map
};

/// The narrowest place of the widest way from start to goal on a lattice over the static map's
/// bounds, as find_grid_path() has it; nothing where they are closed off from each other. Within
/// `free_radius_m` of the two, nothing counts as narrow. `should_stop` ends the search early, with
/// nothing.
std::optional<NarrowPlace> narrowest_place(
    const StaticMap& static_map, const Vector2& start, const Vector2& goal, double step_m,
    double free_radius_m, const std::function<bool()>& should_stop = [] { return false; });

}  // namespace mocha
