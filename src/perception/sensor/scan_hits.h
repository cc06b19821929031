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
  std::vector<Vector2> misses{};  ///< up to where beams met nothing
};

/// Throws std::invalid_argument for a scan and an odometry, both at one time, that no lidar and no
/// odometry measures; what() does not depend on their numbers.
void check_measured(const ScanHits& scan, const Pose& odometry);

/// The hits and misses among `beams`, seen from a robot that stands at `base`, in the frame of the
/// beams. Of those closer together than `spacing_m` one is kept, so that near walls do not outweigh
/// far ones.
ScanHits hits_of(const std::vector<Beam>& beams, const Pose& base, double spacing_m);

/// The beams of a scan, as measured by a robot that stands at `base`; in the plane.
std::vector<Beam> beams_of(const ScanHits& scan, const Pose& base);

/// The hits `depth_m` farther away from the sensor.
ScanHits deepened(ScanHits scan, double depth_m);

/// Every n-th of some things, so that at most `most` are left.
template <class Thing>
std::vector<Thing> evenly_chosen(const std::vector<Thing>& things, std::size_t most) {
  if (things.size() <= most) return things;
  std::vector<Thing> chosen;
  chosen.reserve(most);
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(things[i * things.size() / most]);
  return chosen;
}

/// The same for the hits of a scan.
ScanHits thinned(const ScanHits& scan, std::size_t most);

}  // namespace mocha
