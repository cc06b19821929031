#include "perception/sensor/scan_hits.h"

#include <algorithm>

#include "trajectory/frame_change.h"

namespace mocha {

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
  if (scan.hits.size() <= most) return scan;
  ScanHits thin{scan.time_s, scan.sensor, {}};
  thin.hits.reserve(most);
  for (std::size_t i = 0; i < most; ++i) {
    thin.hits.push_back(scan.hits[i * scan.hits.size() / most]);
  }
  return thin;
}

}  // namespace mocha
