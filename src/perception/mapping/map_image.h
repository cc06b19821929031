#pragma once

#include <string>

#include "world/occupancy_grid.h"

namespace mocha {

/// Maps as map_server knows them: a YAML file (image, resolution, origin, negate, occupied_thresh,
/// free_thresh) and a grey image (binary PGM; one that is read may be a PNG) beside it. Trinary:
/// every cell is occupied, free or unknown, as transparent pixels are.

/// Writes `yaml_path` and the image of the same name ending in .pgm. Throws MapError.
void save_map_image(const OccupancyGrid& grid, const std::string& yaml_path);

/// Throws MapError naming the file at fault.
OccupancyGrid load_map_image(const std::string& yaml_path);

/// Moves a map to where its corners have multiples of its cells as coordinates. Returns by how
/// much, half a cell at most [m].
Vector2 move_to_lattice(OccupancyGrid& grid);

/// The whole file. Throws MapError if it cannot be read.
std::string read_file(const std::string& path);

/// Replaces the file in one step, so that no reader ever meets half of it. Throws MapError.
void write_file(const std::string& path, const std::string& bytes);

}  // namespace mocha
