#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "simulation/world_simulator.h"

namespace mocha {

/// What stands still, for rviz: circles, polygons, places not to be entered, goals. Frame map.
visualization_msgs::MarkerArray world_markers(const World& world);

/// What moves: moving obstacles, and the robots' true footprints with their names. Frame map.
visualization_msgs::MarkerArray moving_markers(const WorldSimulator& simulator);

}  // namespace mocha
