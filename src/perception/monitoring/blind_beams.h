#pragma once

#include <vector>

#include "perception/mapping/occupancy_map.h"
#include "perception/sensor/beam.h"

namespace mocha {

/// Beams without return that met nothing where something stands.
struct BlindBeams {
  double width_rad = 0.0;   ///< of all of them together
  double middle_rad = 0.0;  ///< where most of them look, map frame
};

/// The beams of one scan (map frame), `increment_rad` apart, without return that pass a wall of the
/// map within a few metres. Single beams are lost now and then, and a person
/// that was mapped standing may have left: what counts is more than 1.2 m wide.
BlindBeams blind_beams(const std::vector<Beam>& beams, double increment_rad,
                       const OccupancyMap& map);

}  // namespace mocha
