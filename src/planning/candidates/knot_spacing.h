#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/obstacle_field.h"

namespace mocha {

/// How far apart knots may be.
struct KnotSpacings {
  double narrow_m;  ///< where it is narrow
  double open_m;    ///< where there is plenty of room
};

/// The spacing [m] that the room beside a path asks for: finer the narrower it is, and no coarser
/// than leaves the path pieces for its ramps.
template <int D>
double knot_spacing_for_room(const std::vector<Eigen::Matrix<double, D, 1>>& path,
                             const ObstacleField<D>& field, const KnotSpacings& spacings);

extern template double knot_spacing_for_room<2>(const std::vector<Eigen::Vector2d>&,
                                                const ObstacleField<2>&, const KnotSpacings&);
extern template double knot_spacing_for_room<3>(const std::vector<Eigen::Vector3d>&,
                                                const ObstacleField<3>&, const KnotSpacings&);

}  // namespace mocha
