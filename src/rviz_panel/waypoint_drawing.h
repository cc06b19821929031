#pragma once

#include <nav_msgs/Path.h>
#include <visualization_msgs/MarkerArray.h>

namespace mocha {

/// Waypoints that are being gathered: a line with a numbered dot at each.
visualization_msgs::MarkerArray drawing_of(const nav_msgs::Path& waypoints);

}  // namespace mocha
