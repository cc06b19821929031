#pragma once

#include <string>

#include "world/world_file.h"

namespace mocha {

enum class TightKind { kWall, kCorner, kDeadEnd };

/// Where a robot stands close to walls, in a room of 10 m that is open otherwise.
struct TightStart {
  TightKind kind;
  double gap_m;    ///< body to the wall, and to the second one of a corner; of a dead end, a slot
                   ///< that holds the whole body: the room to both sides and ahead of it, together
                   ///< twice that
  double yaw_rad;  ///< 0: along the wall; of a dead end: -pi/2 nose in, pi/2 nose out
};

/// "jackal", "waveshare_rover" and so on, or "own": a rover whose body is 0.9 x 0.6 m. Throws
/// ParameterError.
RobotModel leaving_model(const std::string& name);

/// Its one robot stands there, and is to go to a place 3 m off in the open.
World leaving_world(const RobotModel& robot, const TightStart& start);

}  // namespace mocha
