#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planning/passing/place_set.h"
#include "topology/static_map/travel_cost.h"
#include "world/obstacle_field.h"

namespace mocha {

/// A way from one place of a PlaceGraph to a neighbour.
struct PlaceMove {
  int to;
  double length_m;
  std::vector<Vector2> path;  ///< from place to place, straight between
  PlaceSet blocked_by;  ///< while a robot stands at one of these places, no other can go this way;
                        ///< `to` is one of them, `from` is not
};

/// Places for the centres of robots of one size, and the ways between them: pebble motion on this
/// graph is what a group of robots can do one by one, whatever their promises keep.
struct PlaceGraph {
  std::vector<Vector2> places;                ///< map frame [m]
  std::vector<std::vector<PlaceMove>> moves;  ///< of each place

  int size() const { return static_cast<int>(places.size()); }
};

/// Where robots can go, and where they can be sent to.
struct PassingGround {
  const StaticMap& static_map;               ///< what was not seen counts as free
  std::vector<BlockedDisc> blocked;          ///< nobody goes there
  const ObstacleField<2>* unseen = nullptr;  ///< what was not seen free; null: all was seen
};

/// How a PlaceGraph is made.
struct PlaceGraphOptions {
  TravelOptions travel;
  double apart_m;          ///< two robots keep between their centres
  double lattice_m = 0.1;  ///< of the paths
};

/// The first places of a PlaceGraph.
struct FixedPlaces {
  std::vector<Vector2> goals;   ///< robots are to be able to stay there: others are chosen apart
  std::vector<Vector2> starts;  ///< robots are there now; others are chosen as if they were not
};

/// The graph of the free space within `window` that can be reached from the fixed places, which are
/// its first places: the goals, then the starts, in this order. Other places are added where the
/// ground was seen, as long as they are `apart_m` from all others and the goals; away from walls
/// first, and narrow ends first, so that corridors hold as many as they can. Neighbours are places
/// of which the surroundings meet; a start has all around it. Robots that are closer than `apart_m`
/// at their places can still leave each other.
PlaceGraph make_place_graph(const PassingGround& ground, const Eigen::AlignedBox2d& window,
                            const FixedPlaces& fixed, const PlaceGraphOptions& options);

/// How far it is from each place to `goal` along the graph, other robots aside [m], where each move
/// counts as so much longer; infinite where there is no way. Ways are as long there as back.
std::vector<double> distances_to(const PlaceGraph& graph, int goal, double per_move_m = 0.0);

}  // namespace mocha
