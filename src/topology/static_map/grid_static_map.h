#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "topology/roadmaps/skeleton_tiles.h"
#include "topology/static_map/static_map.h"
#include "world/distances/distance_field.h"

namespace mocha {

/// A map. Its groups are the components of the solid cells and of the gaps between them that the
/// robot cannot pass; their circles cover the rims of solid matter and stick out by less than 11
/// cm.
class GridStaticMap : public StaticMap {
 public:
  explicit GridStaticMap(std::shared_ptr<const DistanceField> field);
  /// `tiles`: what is known already of its skeleton. Throws std::invalid_argument where they are
  /// those of a map of another size.
  GridStaticMap(std::shared_ptr<const DistanceField> field, SkeletonTiles tiles);

  const DistanceField& field() const override { return *field_; }
  const Eigen::AlignedBox2d& bounds() const override { return bounds_; }
  double detail_m() const override { return 0.5 * field_->resolution_m(); }
  std::optional<Connectivity> connectivity(double clearance_m) const override {
    return Connectivity(*field_, clearance_m);
  }
  std::shared_ptr<const MapSkeleton> skeleton(const TravelOptions& options) const override;
  /// The tiles of the skeleton that was asked for last, if any was.
  std::optional<SkeletonTiles> tiles() const;
  std::vector<ObstacleGroup> groups_within(const Eigen::AlignedBox2d& window,
                                           double clearance_m) const override;

 private:
  std::shared_ptr<const DistanceField> field_;
  Eigen::AlignedBox2d bounds_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const MapSkeleton> skeleton_;  // that was asked for last
};

}  // namespace mocha
