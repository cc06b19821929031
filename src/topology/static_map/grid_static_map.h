#pragma once

#include <memory>
#include <mutex>

#include "topology/static_map/static_map.h"
#include "world/distance_field.h"

namespace mocha {

/// A map. Its groups are the components of the solid cells and of the gaps between them that the
/// robot cannot pass; their circles cover the rims of solid matter and stick out by less than 11
/// cm.
class GridStaticMap : public StaticMap {
 public:
  explicit GridStaticMap(std::shared_ptr<const DistanceField> field);

  const DistanceField& field() const override { return *field_; }
  const Eigen::AlignedBox2d& bounds() const override { return bounds_; }
  double detail_m() const override { return 0.5 * field_->resolution_m(); }
  std::optional<Connectivity> connectivity(double clearance_m) const override {
    return Connectivity(*field_, clearance_m);
  }
  std::shared_ptr<const MapSkeleton> skeleton(const TravelOptions& options) const override;
  std::vector<ObstacleGroup> groups_within(const Eigen::AlignedBox2d& window,
                                           double clearance_m) const override;

 private:
  std::shared_ptr<const DistanceField> field_;
  Eigen::AlignedBox2d bounds_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const MapSkeleton> skeleton_;  // that was asked for last
};

}  // namespace mocha
