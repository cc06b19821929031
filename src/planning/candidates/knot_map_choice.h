#pragma once

#include <memory>
#include <optional>

#include "camouflage/knot_map.h"
#include "planning/candidates/fallback.h"
#include "world/obstacle_field.h"

namespace mocha {

/// By which variables the interior knots of a path are placed: camouflage, unless `fallback` says
/// why waypoints are; it is set where camouflage is not possible. `path` is start, interior knots,
/// end (D x (K + 2)) [m]; a knot may leave it by `travel_m`.
template <int D>
std::shared_ptr<const KnotMap<D>> choose_knot_map(
    const Eigen::Matrix<double, D, Eigen::Dynamic>& path, const ObstacleField<D>& field,
    double travel_m, std::optional<BasicFallback<D>>& fallback);

extern template std::shared_ptr<const KnotMap<2>> choose_knot_map(const Eigen::Matrix2Xd&,
                                                                  const ObstacleField<2>&, double,
                                                                  std::optional<BasicFallback<2>>&);
extern template std::shared_ptr<const KnotMap<3>> choose_knot_map(const Eigen::Matrix3Xd&,
                                                                  const ObstacleField<3>&, double,
                                                                  std::optional<BasicFallback<3>>&);

}  // namespace mocha
