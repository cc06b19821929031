#pragma once

#include <memory>

#include "topology/terrain.h"
#include "world/primitive_field.h"

namespace mocha {

/// Analytic obstacles. Circles and polygons between which the robot cannot pass are one group.
class PrimitiveTerrain : public Terrain {
 public:
  PrimitiveTerrain(std::shared_ptr<const PrimitiveField<2>> field,
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
