#pragma once

#include <Eigen/Core>

#include "world/obstacle_field.h"

namespace mocha {

/// Rays and path keep at least this angle, or a knot could not leave the path.
inline constexpr double kLeastRayAngle_rad = 0.5236;

/// Why a path has no reference points.
enum class ReferenceFault {
  kNone,
  kCoincidentPoints,  ///< beside a knot, points are less than a millimetre apart, or not finite
  kSharpBend,         ///< at a knot, no ray keeps its angle to the path on both sides
};

/// A reference point for each interior knot of a path, or why there is none.
template <int D>
struct ReferencesOrFault {
  Eigen::Matrix<double, D, Eigen::Dynamic> references;  ///< [m], one a knot
  ReferenceFault fault = ReferenceFault::kNone;
  /// Of the first knot that has none [m]; valid where there is a fault.
  Eigen::Matrix<double, D, 1> place = Eigen::Matrix<double, D, 1>::Zero();

  explicit operator bool() const { return fault == ReferenceFault::kNone; }
};

/// One reference point for camouflage about a prey path for each interior knot: the apex of the
/// isosceles right triangle over its chord (paper Fig. 3). `path` is start, K interior knots, end
/// (D x (K + 2)) [m].
///
/// The whole path shares the apex over its chord if every ray keeps the angle; otherwise the path
/// is cut into the longest stretches that do, one apex a stretch. The triangle stands on the side
/// with fewer obstacles up to `side_depth_m` beside the path; in space, in the plane in which the
/// path leaves its chord most, since that is how it gets round obstacles (level, where it is
/// straight). A fault where that fails: the caller then falls back to waypoints as variables.
template <int D>
ReferencesOrFault<D> choose_references(const Eigen::Matrix<double, D, Eigen::Dynamic>& path,
                                       const ObstacleField<D>& field, double side_depth_m);

extern template ReferencesOrFault<2> choose_references<2>(const Eigen::Matrix2Xd&,
                                                          const ObstacleField<2>&, double);
extern template ReferencesOrFault<3> choose_references<3>(const Eigen::Matrix3Xd&,
                                                          const ObstacleField<3>&, double);

}  // namespace mocha
