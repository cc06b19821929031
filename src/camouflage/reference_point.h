#pragma once

#include <Eigen/Core>
#include <optional>

#include "world/obstacle_field.h"

namespace mocha {

/// Reference points for camouflage about a planar prey path (Fig. 3).
struct ReferenceRules {
  /// Height of the apex over the middle of the chord, in half chords; 1 is the isosceles right
  /// triangle.
  double apex_height = 1.0;
  /// Rays and path must keep at least this angle, or a knot could not leave the path.
  double min_angle_rad = 0.5236;
  /// How far beside the path obstacles are counted to find the sparser side [m].
  double side_depth_m = 1.0;
};

using PlanarPoints = Eigen::Matrix2Xd;

/// One reference point for each interior knot. `path` is start, K interior knots, end (2 x (K + 2))
/// [m].
///
/// The whole path shares the apex over its chord, on the side with fewer obstacles, if every ray
/// keeps the angle; otherwise the path is cut into the longest stretches that do, one apex a
/// stretch. Nothing where that fails (for example coincident points): the caller then falls back to
/// waypoints as variables.
std::optional<PlanarPoints> choose_references(const PlanarPoints& path,
                                              const ObstacleField<2>& field,
                                              const ReferenceRules& rules);

}  // namespace mocha
