#pragma once

#include <Eigen/Geometry>

#include "topology/roadmaps/sampled_space.h"
#include "world/obstacle_field.h"

namespace mocha {

/// How close to obstacles paths may come [m].
struct ClearanceOptions {
  double required_m;  ///< at least 0; less is forbidden
  /// Around the start, places that are no closer to obstacles than the start itself are allowed. At
  /// least 0.
  double escape_radius_m;
};

/// A box with obstacles that stand still. Touching obstacles is forbidden whatever the options say.
template <int D>
class StaticSpace : public SampledSpace<D> {
 public:
  using typename SampledSpace<D>::Point;
  using Box = Eigen::AlignedBox<double, D>;

  /// `field` and `cuts` must live longer. Throws std::invalid_argument for options out of range.
  StaticSpace(const ObstacleField<D>& field, const Cuts<D>& cuts, const Box& bounds,
              const Point& start, const ClearanceOptions& options);

  Point at(const Point& shares) const override;
  std::optional<double> clearance_m(const Point& p) const override;
  std::optional<double> clearance_m(const Point& p, const Point& q) const override;
  SignatureKey key(const Point& p, const Point& q) const override { return key_of(cuts_, p, q); }

 private:
  std::optional<double> traced(const Point& p, const Point& q, double required_m) const;

  const ObstacleField<D>& field_;
  const Cuts<D>& cuts_;
  const Box bounds_;
  const Point start_;
  const ClearanceOptions options_;
  double escape_m_;  // the clearance required within the escape radius
};

extern template class StaticSpace<2>;
extern template class StaticSpace<3>;

}  // namespace mocha
