#pragma once

#include <Eigen/Core>

namespace mocha {

using Vector3 = Eigen::Vector3d;

/// What a beam says about its end; the space before it is free.
enum class BeamEnd {
  kHit,      ///< something is there
  kMiss,     ///< nothing was met: the end is free as well
  kIgnored,  ///< something is there that must not enter the map: nothing is said about the end
};

/// One measured ray, map frame [m].
struct Beam {
  Vector3 origin;
  Vector3 end;
  BeamEnd kind;
  double time_s;  ///< when it was measured
};

/// From its origin to its end, in the plane [m].
inline Eigen::Vector2d ray(const Beam& beam) { return (beam.end - beam.origin).head<2>(); }

/// False for a point [m] that is not finite, or so far away that the index of its cell would
/// overflow.
template <class Point>
bool is_usable(const Eigen::MatrixBase<Point>& point) {
  constexpr double kFarthest_m = 1e5;
  return (point.array().abs() < kFarthest_m).all();
}

inline bool is_usable(const Beam& beam) { return is_usable(beam.origin) && is_usable(beam.end); }

}  // namespace mocha
