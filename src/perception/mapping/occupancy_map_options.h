#pragma once

#include "config/parameter_table.h"

namespace mocha {

struct OccupancyMapOptions {
  double resolution_m;      ///< edge of a voxel
  double scan_height_m;     ///< planar scans are flattened into the layer of voxels at this
                            ///< height above the map's z = 0
  double min_height_m;      ///< lower end of the robot's height band
  double max_height_m;      ///< upper end
  double hit_probability;   ///< that a voxel in which a beam ends is occupied, from this beam alone
  double miss_probability;  ///< that a voxel which a beam passes is occupied, from this beam alone
  double lowest_probability;  ///< occupancy is clamped, so that a changed world is learnt in finite
                              ///< time
  double highest_probability;

  /// From the parameters of the same names, without units; the resolution is not one of them.
  static OccupancyMapOptions from(const ParameterTable& values, double resolution_m);

  /// These. Throws std::invalid_argument, naming the value and its range.
  const OccupancyMapOptions& checked() const;
};

}  // namespace mocha
