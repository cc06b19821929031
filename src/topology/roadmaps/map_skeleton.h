#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "topology/roadmaps/roadmap.h"
#include "topology/roadmaps/skeleton_tiles.h"

namespace mocha {

/// The skeleton of a map's free space and what stands between, for one robot. Its tiles are made
/// when they are first asked for; those that another one has made may be handed on to it.
class MapSkeleton {
 public:
  /// `tiles`: what is known of them already. Throws std::invalid_argument where they are those of a
  /// map of another size.
  MapSkeleton(std::shared_ptr<const DistanceField> field, SkeletonTiles tiles);

  const TravelOptions& options() const { return options_; }
  /// As far as they are made.
  SkeletonTiles tiles() const;

  /// Makes the tiles that are missing; false where `should_stop` ended that early. Only then all
  /// that follows is there.
  bool complete(const TravelCost& cost, const std::function<bool()>& should_stop) const;

  /// A place inside of each obstacle: of what stands, one for what hangs together and has no gap
  /// that is half as wide as the robot needs.
  const std::vector<Vector2>& obstacles() const { return obstacles_; }

  /// From the start that `cost` knows, around the discs that it knows; priced.
  ///
  /// A class of paths that keep the required clearance is missing only where every path of it comes
  /// to some tile more than once.
  Roadmap<2> roadmap(const TravelCost& cost, const Vector2& goal) const;

 private:
  static std::vector<Vector2> joined_obstacles(const SkeletonTiles& tiles);
  /// The corners around a place, as far as the map has them.
  CornerWindow around(const Vector2& place, double radius_m) const;

  const std::shared_ptr<const DistanceField> field_;
  const TravelOptions options_;
  mutable std::mutex mutex_;  // of what follows, until it is complete
  mutable SkeletonTiles tiles_;
  mutable std::atomic<bool> is_complete_{false};  // all made, obstacles joined
  mutable std::vector<Vector2> obstacles_;
};

}  // namespace mocha
