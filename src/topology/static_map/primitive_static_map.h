#pragma once

#include <memory>

#include "topology/static_map/static_map.h"
#include "world/primitive_field.h"

namespace mocha {

/// Analytic obstacles. Circles and polygons between which the robot cannot pass are one group.
class PrimitiveStaticMap : public StaticMap {
 public:
  PrimitiveStaticMap(std::shared_ptr<const PrimitiveField<2>> field,
                     const Eigen::AlignedBox2d& bounds);

  const PrimitiveField<2>& field() const override { return *field_; }
  const Eigen::AlignedBox2d& bounds() const override { return bounds_; }
  double detail_m() const override;
  std::vector<ObstacleGroup> groups_within(const Eigen::AlignedBox2d& window,
                                           double clearance_m) const override;

 private:
  std::shared_ptr<const PrimitiveField<2>> field_;
  Eigen::AlignedBox2d bounds_;
};

}  // namespace mocha
