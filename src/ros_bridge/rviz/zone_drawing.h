#pragma once

#include <vector>

#include "ros_bridge/rviz/markers.h"
#include "world/zones.h"

namespace mocha {

/// Outlines of zones, red where they are not to be entered and yellow where a speed holds, with
/// names and speeds; and dashed, the path on which the robot leaves the one that it stands in.
void draw_zones(const Zones& zones, const std::vector<Vector2>& exit, Drawing& drawing);

}  // namespace mocha
