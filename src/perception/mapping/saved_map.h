#pragma once

#include <string>

#include "perception/mapping/map_error.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// The planar slice of a saved map, whatever the size of its cells: .bt and .ot (OctoMap), .yaml
/// (map_server). An octree's walls are those between the two heights. Throws MapError naming the
/// file.
OccupancyGrid load_saved_slice(const std::string& path, double min_height_m, double max_height_m);

}  // namespace mocha
