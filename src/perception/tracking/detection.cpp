#include "perception/tracking/detection.h"

#include <algorithm>
#include <cmath>

#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

constexpr double kBehind_m = 0.1;    // a return that much farther away is behind an edge
constexpr double kWidest_rad = 1.2;  // half a sector; wider ones are too near to be measured so
constexpr double kNextBeams = 2.5;   // spacings; a hit farther away is no neighbour in the scan

/// Where one edge of a cluster is.
struct Edge {
  int beam = 0;
  double angle_rad = 0.0;  ///< from the cluster's middle
};

/// Seen from the cluster's middle outward (`side` 1: left, -1: right), nothing is known to end
/// here.
bool goes_on(const std::vector<Beam>& beams, const Edge& edge, const Vector2& middle, double side,
             double spacing_rad) {
  const int size = static_cast<int>(beams.size());
  for (int next : {(edge.beam + 1) % size, (edge.beam + size - 1) % size}) {
    const double beyond_rad = side * (angle_between(middle, ray(beams[next])) - edge.angle_rad);
    if (!(beyond_rad > 0.0 && beyond_rad < kNextBeams * spacing_rad)) continue;
    return beams[next].kind != BeamEnd::kMiss &&
           ray(beams[next]).norm() < ray(beams[edge.beam]).norm() + kBehind_m;
  }
  return true;
}

/// Between neighbouring beams.
double spacing_of(const std::vector<Beam>& beams, const BeamIndices& cluster) {
  double spacing_rad = M_PI;
  for (int i : cluster) {
    const Beam& next = beams[(i + 1) % beams.size()];
    const double angle_rad = std::abs(angle_between(ray(beams[i]), ray(next)));
    if (angle_rad > 0.0) spacing_rad = std::min(spacing_rad, angle_rad);
  }
  return spacing_rad;
}

}  // namespace

Vector2 Detection::centre(double radius) const {
  const double distance_m = nearest_m + radius;
  const double half_rad = std::asin(radius / distance_m);
  double bearing_rad = 0.5 * (right_rad + left_rad);
  if (left_hidden && !right_hidden) bearing_rad = right_rad + half_rad;
  if (right_hidden && !left_hidden) bearing_rad = left_rad - half_rad;
  return sensor + distance_m * Vector2(std::cos(bearing_rad), std::sin(bearing_rad));
}

Detection sight_disc(const std::vector<Beam>& beams, const BeamIndices& cluster) {
  Vector2 middle = Vector2::Zero();
  for (int i : cluster) middle += ray(beams[i]).normalized();
  Edge right{0, INFINITY};
  Edge left{0, -INFINITY};
  Detection detection{};
  detection.nearest_m = INFINITY;
  for (int i : cluster) {
    const double angle_rad = angle_between(middle, ray(beams[i]));
    if (angle_rad < right.angle_rad) right = {i, angle_rad};
    if (angle_rad > left.angle_rad) left = {i, angle_rad};
    detection.nearest_m = std::min(detection.nearest_m, ray(beams[i]).norm());
    detection.time_s += beams[i].time_s / static_cast<double>(cluster.size());
    detection.hits.push_back(beams[i].end.head<2>());
  }
  const double spacing_rad = spacing_of(beams, cluster);
  const double bearing_rad = std::atan2(middle.y(), middle.x());
  detection.sensor = beams[cluster[cluster.size() / 2]].origin.head<2>();
  detection.right_rad = bearing_rad + right.angle_rad - 0.5 * spacing_rad;
  detection.left_rad = bearing_rad + left.angle_rad + 0.5 * spacing_rad;
  detection.right_hidden = goes_on(beams, right, middle, -1.0, spacing_rad);
  detection.left_hidden = goes_on(beams, left, middle, 1.0, spacing_rad);
  const double alpha = std::min(0.5 * (detection.left_rad - detection.right_rad), kWidest_rad);
  const double chord_m = extent_m(beams, cluster) + spacing_rad * detection.nearest_m;
  detection.radius_m = 0.5 * chord_m / std::cos(alpha);
  return detection;
}

View view_of(const std::vector<Beam>& beams, const Vector2& centre, double radius_m) {
  int passing = 0;
  int before = 0;
  int there = 0;
  for (const Beam& beam : beams) {
    const Vector2 to = centre - beam.origin.head<2>();
    const double length = ray(beam).norm();
    const double along = to.dot(ray(beam)) / length;
    const double off = std::abs(cross(to, ray(beam))) / length;
    if (!(along > 0.0 && off < 0.5 * radius_m)) continue;  // a length that is not finite, too
    if (length > along + radius_m) {
      ++passing;
    } else if (length < along - radius_m - kBehind_m) {
      ++before;
    } else {
      ++there;
    }
  }
  const int all = passing + before + there;
  if (all == 0) return View::kUnseen;
  if (2 * passing > all) return View::kFree;
  return 2 * before > all ? View::kHidden : View::kTaken;
}

}  // namespace mocha
