#include "perception/mapping/occupancy_map_options.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

void require(bool holds, const std::string& name, double value, const std::string& range) {
  if (holds) return;
  throw std::invalid_argument("OccupancyMap: " + name + " is " + std::to_string(value) +
                              ", but must be " + range);
}

}  // namespace

const OccupancyMapOptions& OccupancyMapOptions::checked() const {
  const OccupancyMapOptions& o = *this;
  require(o.resolution_m >= 0.005 && o.resolution_m <= 1.0, "resolution", o.resolution_m,
          "0.005 to 1 m");
  require(std::abs(o.min_height_m) <= 100.0, "min_height", o.min_height_m, "-100 to 100 m");
  require(o.max_height_m > o.min_height_m && o.max_height_m <= o.min_height_m + 10.0, "max_height",
          o.max_height_m, "above min_height, by at most 10 m");
  require(o.scan_height_m >= o.min_height_m && o.scan_height_m <= o.max_height_m, "scan_height",
          o.scan_height_m, "between min_height and max_height");
  require(o.hit_probability > 0.5 && o.hit_probability < 1.0, "hit_probability", o.hit_probability,
          "above 0.5 and below 1");
  require(o.miss_probability > 0.0 && o.miss_probability < 0.5, "miss_probability",
          o.miss_probability, "above 0 and below 0.5");
  require(o.lowest_probability > 0.0 && o.lowest_probability < 0.5, "lowest_probability",
          o.lowest_probability, "above 0 and below 0.5");
  require(o.highest_probability > 0.5 && o.highest_probability < 1.0, "highest_probability",
          o.highest_probability, "above 0.5 and below 1");
  return o;
}

OccupancyMapOptions OccupancyMapOptions::from(const ParameterTable& values, double resolution_m) {
  OccupancyMapOptions options;
  options.resolution_m = resolution_m;
  options.scan_height_m = values.number("scan_height");
  options.min_height_m = values.number("min_height");
  options.max_height_m = values.number("max_height");
  options.hit_probability = values.number("hit_probability");
  options.miss_probability = values.number("miss_probability");
  options.lowest_probability = values.number("lowest_probability");
  options.highest_probability = values.number("highest_probability");
  return options;
}

}  // namespace mocha
