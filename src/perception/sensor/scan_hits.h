#pragma once

#include <cstddef>
#include <vector>

#include "perception/sensor/beam.h"
#include "trajectory/motion.h"

namespace mocha {

/// What a scan met, as seen from the robot at one time: positions in base_link [m].
struct ScanHits {
  double time_s = 0.0;
  Vector2 sensor = Vector2::Zero();
  std::vector<Vector2> hits;
};

/// The hits among `beams`, seen from a robot that stands at `base`, in the frame of the beams. Of
/// hits closer together than `spacing_m` one is kept, so that near walls do not outweigh far ones.
ScanHits hits_of(const std::vector<Beam>& beams, const Pose& base, double spacing_m);

/// The hits `depth_m` farther away from the sensor.
ScanHits deepened(ScanHits scan, double depth_m);

/// Every n-th hit, so that at most `most` are left.
ScanHits thinned(const ScanHits& scan, std::size_t most);

}  // namespace mocha
