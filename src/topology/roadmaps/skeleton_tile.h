#pragma once

#include <memory>
#include <vector>

#include "topology/roadmaps/shared_corners.h"
#include "topology/static_map/travel_cost.h"
#include "world/corner_window.h"
#include "world/distances/distance_field.h"

namespace mocha {

/// The skeleton of the free space of one tile of a map, as a part of a roadmap.
///
/// Wherever a way leaves the tile there is a gate: one for each stretch of its border on which one
/// may be, the same seen from either side. Between gates, the skeleton has the pieces and the holes
/// of the tile's free space. So each path on the map can be deformed into one along the skeletons
/// of its tiles.
struct SkeletonTile {
  struct Edge {
    int from;                        ///< index of a node
    int to;                          ///< of another one
    SharedCorners<Vector2> between;  ///< of the line from one to the other, ends left out
    double cost_m;
  };
  std::vector<int> nodes;  ///< numbers of corners: y * columns of the field + x
  std::vector<Edge> edges;
};

/// Makes one tile after the other, in the same memory.
class SkeletonTiler {
 public:
  /// Keeps references to both.
  SkeletonTiler(const DistanceField& field, const TravelCost& cost);
  ~SkeletonTiler();

  /// `anchors`: numbers of corners of the window that are to be nodes, if one may be there at all.
  /// Besides the skeleton, nodes that see each other have straight edges to the nearest of them.
  SkeletonTile tile(const CornerWindow& window, const std::vector<int>& anchors);

 private:
  class Builder;
  std::unique_ptr<Builder> builder_;
};

}  // namespace mocha
