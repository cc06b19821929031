#pragma once

#include <vector>

#include "topology/signatures/h_signature.h"
#include "topology/static_map/travel_cost.h"

namespace mocha {

/// A cheaper path of the same class: corners are cut wherever the straight line costs no more and
/// crosses the same cuts. The path must be possible: where it costs infinitely much nothing is cut.
std::vector<Vector2> with_shortcuts(const std::vector<Vector2>& path, const TravelCost& cost,
                                    const Cuts<2>& cuts);

/// Of a path with straight lines between its points.
double cost_of(const std::vector<Vector2>& path, const TravelCost& cost);

}  // namespace mocha
