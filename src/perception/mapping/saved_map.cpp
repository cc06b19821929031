#include "perception/mapping/saved_map.h"

#include <filesystem>

#include "perception/mapping/map_image.h"
#include "perception/mapping/occupancy_map.h"

namespace mocha {

OccupancyGrid load_saved_slice(const std::string& path, double min_height_m, double max_height_m) {
  if (std::filesystem::path(path).extension() == ".yaml") {
    OccupancyGrid grid = load_map_image(path);
    move_to_lattice(grid);  // as perception does
    return grid;
  }
  OccupancyMapOptions options;
  options.resolution_m = 1.0;  // the file has its own, which are no larger
  options.min_height_m = min_height_m;
  options.max_height_m = max_height_m;
  options.scan_height_m = 0.5 * (min_height_m + max_height_m);
  // Nothing is measured: any probabilities will do.
  options.hit_probability = options.highest_probability = 0.6;
  options.miss_probability = options.lowest_probability = 0.4;
  OccupancyMap map(options);
  map.load(path);
  return map.slice(map.options().resolution_m);
}

}  // namespace mocha
