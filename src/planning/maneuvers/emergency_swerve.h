#pragma once

#include "planning/candidates/maneuver.h"

namespace mocha {

/// What is left to a robot under way besides braking along its path: to turn off to either side,
/// faster, at its speed or braking, and then to brake to rest. They are made for the limits of an
/// emergency, bind at once, and so are none where a peer is near; none where the robot hardly
/// moves.
Maneuvers emergency_swerves(const ManeuverStart& start);

}  // namespace mocha
