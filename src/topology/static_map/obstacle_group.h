#pragma once

#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// The narrowest passage that tells two obstacles apart, of the clearance that is required.
inline constexpr double kNarrowestPassage = 0.5;

/// One obstacle as topology sees it: solid matter between whose parts the robot cannot pass, such
/// as a wall, or two crates that stand close together. A path goes round all of it or not at all.
struct ObstacleGroup {
  /// A point of the solid matter itself. Never a centroid, which may lie in free space.
  Vector2 representative = Vector2::Zero();
  /// Circles that stand for the rim of the solid matter where paths are searched (not where they
  /// are proved): exact for circles, else points or small circles so close together that the robot
  /// does not fit between them. Map frame, metres.
  std::vector<Circle> cover;
};

}  // namespace mocha
