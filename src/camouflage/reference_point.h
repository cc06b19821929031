#pragma once

#include <Eigen/Core>
#include <optional>

#include "world/obstacle_field.h"

namespace mocha {

/// Reference points for camouflage about a prey path (paper Fig. 3).
struct ReferenceOptions {
  /// Height of the apex over the middle of the chord, in half chords; 1 is the isosceles right
  /// triangle.
  double apex_height = 1.0;
  /// Rays and path must keep at least this angle, or a knot could not leave the path.
  double min_angle_rad = 0.5236;
  /// How far beside the path obstacles are counted to find the sparser side [m].
  double side_depth_m = 1.0;
};

/// One reference point for each interior knot. `path` is start, K interior knots, end (D x (K + 2))
/// [m].
///
/// The whole path shares the apex over its chord if every ray keeps the angle; otherwise the path
/// is cut into the longest stretches that do, one apex a stretch. The triangle stands on the side
/// with fewer obstacles; in space, in the plane in which the path leaves its chord most, since that
/// is how it gets round obstacles (level, where it is straight). Nothing where that fails (for
/// example coincident points): the caller then falls back to waypoints as variables.
template <int D>
std::optional<Eigen::Matrix<double, D, Eigen::Dynamic>> choose_references(
    const Eigen::Matrix<double, D, Eigen::Dynamic>& path, const ObstacleField<D>& field,
    const ReferenceOptions& options);

extern template std::optional<Eigen::Matrix2Xd> choose_references<2>(const Eigen::Matrix2Xd&,
                                                                     const ObstacleField<2>&,
                                                                     const ReferenceOptions&);
extern template std::optional<Eigen::Matrix3Xd> choose_references<3>(const Eigen::Matrix3Xd&,
                                                                     const ObstacleField<3>&,
                                                                     const ReferenceOptions&);

}  // namespace mocha
