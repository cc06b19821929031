#pragma once

#include <optional>
#include <vector>

#include "perception/sensor/scan_hits.h"

namespace mocha {

/// Where a scan was taken, as seen from another one.
struct ScanAlignment {
  Pose pose;             ///< of the scan's base_link in that of the reference
  double inliers = 0.0;  ///< share of its hits that lie on surfaces of the reference
};

/// A scan that others are aligned to, by the distances of their hits to its surfaces (Censi, "An
/// ICP variant using a point-to-line metric", ICRA 2008). What moves or has come into sight has no
/// say as long as more hits are on what stands.
class ReferenceScan {
 public:
  /// `scan` has all hits of a sweep.
  explicit ReferenceScan(const ScanHits& scan);

  /// Beginning from a guess of the scan's base_link in the reference's, a few decimetres off at
  /// most. Nothing where too few hits lie on surfaces of the reference, or where these leave a
  /// direction open, as in a long corridor.
  std::optional<ScanAlignment> align(const ScanHits& scan, const Pose& guess) const;

 private:
  /// A hit, and the straight line through it and its neighbours.
  struct Surface {
    double bearing_rad;  ///< from the sensor
    Vector2 centre;
    Vector2 normal;
  };

  std::optional<Surface> surface_at(const std::vector<Vector2>& hits, int index) const;
  const Surface* nearest(const Vector2& point, double reach_m) const;

  Vector2 sensor_;
  std::vector<Surface> surfaces_;  // by bearing
};

}  // namespace mocha
