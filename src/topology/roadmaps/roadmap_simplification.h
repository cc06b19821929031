#pragma once

#include "topology/roadmaps/roadmap.h"
#include "topology/static_map/travel_cost.h"

namespace mocha {

/// A place moved off obstacles that are closer than required, if a few steps suffice. Around a
/// narrow start what is allowed stays.
Vector2 pushed_off(Vector2 p, const TravelCost& cost);

/// Gives edges their cost instead of their length, and leaves out those that are impossible. Where
/// a roadmap was made on circles that only stand for the static map, its corners are moved off the
/// obstacles by what is missing, if a few steps suffice.
void price(Roadmap<2>& roadmap, const TravelCost& cost);

/// The same paths on fewer nodes: dead ends are left out, and nodes with only two edges become
/// corners of one edge.
Roadmap<2> contracted(const Roadmap<2>& roadmap);

/// Adds straight edges from each node to the nearest ones that it sees, so that the lengths of
/// paths are closer to those of the shortest paths of their class than paths midway between
/// obstacles are.
void add_shortcuts(Roadmap<2>& roadmap, const TravelCost& cost);

}  // namespace mocha
