#include "perception/sensor/scan_hits.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kFarthestHit_m = 1000.0;  // no lidar sees farther

}  // namespace

void check_measured(const ScanHits& scan, const Pose& odometry) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  const auto seen = [](const Vector2& point) { return point.norm() <= kFarthestHit_m; };
  require(std::isfinite(scan.time_s), "the scan's time is not finite");
  require(seen(scan.sensor) && std::all_of(scan.hits.begin(), scan.hits.end(), seen),
          "the scan's sensor or a hit is not finite, or more than 1 km from the robot");
  require(is_usable(odometry.position) && std::isfinite(odometry.yaw_rad),
          "the odometry is not finite, or too far away");
}

ScanHits hits_of(const std::vector<Beam>& beams, const Pose& base, double spacing_m) {
  ScanHits scan;
  if (beams.empty()) return scan;
  const Eigen::Rotation2Dd to_base(-base.yaw_rad);
  const auto seen = [&](const Vector3& point) -> Vector2 {
    return to_base * (point.head<2>() - base.position);
  };
  scan.time_s = beams.back().time_s;
  scan.sensor = seen(beams.back().origin);
  for (const Beam& beam : beams) {
    if (beam.kind != BeamEnd::kHit || !is_usable(beam)) continue;
    const Vector2 hit = seen(beam.end);
    if (scan.hits.empty() || (hit - scan.hits.back()).norm() >= spacing_m) scan.hits.push_back(hit);
  }
  return scan;
}

ScanHits deepened(ScanHits scan, double depth_m) {
  for (Vector2& hit : scan.hits) {
    const Vector2 ray = hit - scan.sensor;
    hit += depth_m / std::max(ray.norm(), depth_m) * ray;
  }
  return scan;
}

ScanHits thinned(const ScanHits& scan, std::size_t most) {
  return {scan.time_s, scan.sensor, evenly_chosen(scan.hits, most)};
}

}  // namespace mocha
