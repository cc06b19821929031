#include "perception/saved_map.h"

#include <filesystem>

#include "perception/map_image.h"
#include "perception/octree_file.h"

namespace mocha {

OccupancyGrid load_saved_slice(const std::string& path, OccupancyMapOptions options) {
  if (std::filesystem::path(path).extension() == ".yaml") return load_map_image(path);
  options.resolution_m = parse_octree_file(read_file(path), path).resolution_m;
  OccupancyMap map(options);
  map.load(path);
  return map.slice(options.resolution_m);
}

}  // namespace mocha
