#pragma once

#include <rviz/display_group.h>

#include <string>

namespace mocha {

/// Shows the map of one robot, and hides those of the others: displays named "Map" in groups that
/// have the robots' names.
void show_map_of(const std::string& robot, rviz::DisplayGroup& displays);

}  // namespace mocha
