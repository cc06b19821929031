#pragma once

#include <Eigen/Core>
#include <optional>

#include "world/obstacle_field.h"

namespace mocha {

/// Rays and path keep at least this angle, or a knot could not leave the path.
inline constexpr double kLeastRayAngle_rad = 0.5236;

/// One reference point for camouflage about a prey path for each interior knot: the apex of the
/// isosceles right triangle over its chord (paper Fig. 3). `path` is start, K interior knots, end
/// (D x (K + 2)) [m].
///
/// The whole path shares the apex over its chord if every ray keeps the angle; otherwise the path
/// is cut into the longest stretches that do, one apex a stretch. The triangle stands on the side
/// with fewer obstacles up to `side_depth_m` beside the path; in space, in the plane in which the
/// path leaves its chord most, since that is how it gets round obstacles (level, where it is
/// straight). Nothing where that fails (for example coincident points): the caller then falls back
/// to waypoints as variables.
template <int D>
std::optional<Eigen::Matrix<double, D, Eigen::Dynamic>> choose_references(
    const Eigen::Matrix<double, D, Eigen::Dynamic>& path, const ObstacleField<D>& field,
    double side_depth_m);

extern template std::optional<Eigen::Matrix2Xd> choose_references<2>(const Eigen::Matrix2Xd&,
                                                                     const ObstacleField<2>&,
                                                                     double);
extern template std::optional<Eigen::Matrix3Xd> choose_references<3>(const Eigen::Matrix3Xd&,
                                                                     const ObstacleField<3>&,
                                                                     double);

}  // namespace mocha
