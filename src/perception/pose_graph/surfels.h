#pragma once

#include <cstddef>
#include <vector>

#include "perception/sensor/scan_hits.h"

namespace mocha {

/// A piece of a wall: a hit, and where its wall faces.
struct Surfel {
  Vector2 point;   ///< [m]
  Vector2 normal;  ///< of length 1, towards the sensor
};

/// The hits of a scan that lie on something flat, each on the line that its neighbours make, in the
/// frame of the scan. Hits must be in the order of their beams. At most `most`, evenly chosen.
std::vector<Surfel> surfels_of(const ScanHits& scan, std::size_t most);

/// As seen from the frame in which their own frame stands at `frame`.
Surfel placed(const Pose& frame, const Surfel& surfel);

}  // namespace mocha
