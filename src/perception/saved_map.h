#pragma once

#include <string>

#include "perception/occupancy_map.h"

namespace mocha {

/// The planar slice of a saved map, whatever the size of its cells: .bt and .ot (OctoMap), .yaml
/// (map_server). Of `options` the height band counts. Throws MapError naming the file.
OccupancyGrid load_saved_slice(const std::string& path, OccupancyMapOptions options);

}  // namespace mocha
