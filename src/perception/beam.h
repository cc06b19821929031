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

}  // namespace mocha
