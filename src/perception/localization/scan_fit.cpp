#include "perception/localization/scan_fit.h"

#include <cmath>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

/// Whether the straight line meets an occupied cell, looking twice a cell.
bool is_blocked(const LikelihoodField& walls, const Vector2& from, const Vector2& to) {
  const Vector2 way = to - from;
  const int steps = static_cast<int>(std::ceil(2.0 * way.norm() / walls.map().resolution_m));
  for (int i = 0; i < steps; ++i) {
    if (walls.cell(from + way * (i / static_cast<double>(steps))) == OccupancyGrid::kOccupied)
      return true;
  }
  return false;
}

}  // namespace

ScanFit fit_of(const ScanHits& scan, const Pose& pose, const LikelihoodField& walls,
               double tolerance_m) {
  ScanFit fit;
  const Vector2 sensor = composed(pose, {scan.sensor, 0.0}).position;
  for (const Vector2& seen : scan.hits) {
    const Vector2 hit = composed(pose, {seen, 0.0}).position;
    const Vector2 ray = hit - sensor;
    const double length_m = ray.norm();
    const double before = std::max(0.0, 1.0 - 2.0 * tolerance_m / std::max(length_m, 1e-9));
    if (is_blocked(walls, sensor, sensor + before * ray)) {
      ++fit.behind;
    } else if (walls.sample(hit).distance_m <= tolerance_m) {
      ++fit.on_wall;
    } else if (walls.cell(hit) == OccupancyGrid::kUnknown) {
      ++fit.unknown;
    } else {
      ++fit.in_free;
    }
  }
  return fit;
}

}  // namespace mocha
