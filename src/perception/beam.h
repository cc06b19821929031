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

/// False for coordinates that are not finite, or so large that indices of cells would overflow.
inline bool is_usable(const Beam& beam) {
  constexpr double kFarthest_m = 1e5;
  return (beam.origin.array().abs() < kFarthest_m).all() &&
         (beam.end.array().abs() < kFarthest_m).all();
}

}  // namespace mocha
