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
  require(seen(scan.sensor) && std::all_of(scan.hits.begin(), scan.hits.end(), seen) &&
              std::all_of(scan.misses.begin(), scan.misses.end(), seen),
          "the scan's sensor or a beam's end is not finite, or more than 1 km from the robot");
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
    if (beam.kind == BeamEnd::kIgnored || !is_usable(beam)) continue;
    std::vector<Vector2>& ends = beam.kind == BeamEnd::kHit ? scan.hits : scan.misses;
    const Vector2 end = seen(beam.end);
    if (ends.empty() || (end - ends.back()).norm() >= spacing_m) ends.push_back(end);
  }
  return scan;
}

std::vector<Beam> beams_of(const ScanHits& scan, const Pose& base) {
  const auto placed = [&](const Vector2& seen) {
    const Vector2 position = composed(base, {seen, 0.0}).position;
    return Vector3(position.x(), position.y(), 0.0);
  };
  std::vector<Beam> beams;
  beams.reserve(scan.hits.size() + scan.misses.size());
  const Vector3 origin = placed(scan.sensor);
  for (const Vector2& hit : scan.hits)
    beams.push_back({origin, placed(hit), BeamEnd::kHit, scan.time_s});
  for (const Vector2& miss : scan.misses)
    beams.push_back({origin, placed(miss), BeamEnd::kMiss, scan.time_s});
  return beams;
}

ScanHits deepened(ScanHits scan, double depth_m) {
  for (Vector2& hit : scan.hits) {
    const Vector2 ray = hit - scan.sensor;
    hit += depth_m / std::max(ray.norm(), depth_m) * ray;
  }
  return scan;
}

ScanHits thinned(const ScanHits& scan, std::size_t most) {
  return {scan.time_s, scan.sensor, evenly_chosen(scan.hits, most), {}};
}

}  // namespace mocha
