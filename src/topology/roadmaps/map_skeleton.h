#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "topology/roadmaps/obstacle_tile.h"
#include "topology/roadmaps/roadmap.h"
#include "topology/roadmaps/skeleton_tile.h"
#include "topology/static_map/travel_options.h"

namespace mocha {

/// The skeleton of a map's free space and what stands between, for one robot: in tiles, which are
/// made when they are first asked for and kept from map to map.
class MapSkeleton {
 public:
  MapSkeleton(std::shared_ptr<const DistanceField> field, const TravelOptions& options);

  /// That of the same map after a change, `before` its distances: where those of a tile are the
  /// same, the tile is. `changed` holds all corners whose distances differ.
  MapSkeleton(const MapSkeleton& before, std::shared_ptr<const DistanceField> field,
              const CornerWindow& changed);

  const TravelOptions& options() const { return options_; }

  /// A place inside of each obstacle: of what stands, one for what hangs together and has no gap
  /// that is half as wide as the robot needs.
  const std::vector<Vector2>& obstacles(const TravelCost& cost) const;

  /// From the start that `cost` knows, around the discs that it knows; priced.
  ///
  /// A class of paths that keep the required clearance is missing only where every path of it comes
  /// to some tile more than once.
  Roadmap<2> roadmap(const TravelCost& cost, const Vector2& goal) const;

 private:
  struct Tile {
    SkeletonTile skeleton;
    ObstacleTile obstacles;
  };

  CornerWindow window(int tile) const;
  /// Those that share a corner with the box.
  std::vector<int> tiles_at(const Vector2& low, const Vector2& high) const;
  /// Makes what is missing.
  void complete(const TravelCost& cost) const;
  std::vector<Vector2> joined_obstacles() const;

  std::shared_ptr<const DistanceField> field_;
  const TravelOptions options_;
  int tile_columns_;
  int tile_rows_;
  mutable std::mutex mutex_;
  mutable std::vector<std::shared_ptr<const Tile>> tiles_;  // row by row; null: not made yet
  mutable bool is_complete_ = false;                        // all made, obstacles joined
  mutable std::vector<Vector2> obstacles_;
};

}  // namespace mocha
