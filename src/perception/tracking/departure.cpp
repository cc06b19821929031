#include "perception/tracking/departure.h"

#include <algorithm>
#include <cmath>

#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

constexpr double kFreeShare = 0.5;       // of the former hits that are passed
constexpr std::size_t kMostHits = 8;     // that are looked at
constexpr double kBesideBeam_m = 0.075;  // a beam so near to a place tells whether that is free
constexpr double kBeyond_m = 0.15;       // it passes if it ends so much farther away

/// Some beams lead there, and all of these pass. At a slanted wall some would end before.
bool is_passed(const Vector2& place, const std::vector<Beam>& beams) {
  bool any = false;
  for (const Beam& beam : beams) {
    const Vector2 to = place - beam.origin.head<2>();
    const Vector2 ray = (beam.end - beam.origin).head<2>();
    const double length_m = ray.norm();
    const double along_m = to.dot(ray) / length_m;
    const double off_m = std::abs(cross(to, ray)) / length_m;
    if (!(along_m > 0.0 && off_m < kBesideBeam_m)) continue;  // also a length that is not finite
    if (length_m < along_m + kBeyond_m) return false;
    any = true;
  }
  return any;
}

bool is_free(const std::vector<Vector2>& hits, const std::vector<Beam>& beams) {
  const std::size_t step = (hits.size() + kMostHits - 1) / kMostHits;
  std::size_t looked_at = 0;
  std::size_t passed = 0;
  for (std::size_t i = 0; i < hits.size(); i += step) {
    ++looked_at;
    passed += is_passed(hits[i], beams) ? 1 : 0;
  }
  return static_cast<double>(passed) >= kFreeShare * static_cast<double>(looked_at);
}

bool hides(const Detection& now, const Vector2& centre, const Vector2& place) {
  const Vector2 to = place - now.sensor;
  const double middle_rad = 0.5 * (now.right_rad + now.left_rad);
  const double off_rad = std::remainder(std::atan2(to.y(), to.x()) - middle_rad, 2.0 * M_PI);
  return std::abs(off_rad) < 0.5 * (now.left_rad - now.right_rad) &&
         (centre - now.sensor).norm() + kBeyond_m < to.norm();
}

}  // namespace

bool has_left(const SeenPlace& place, const Detection& now, const Vector2& centre,
              const std::vector<Beam>& beams) {
  for (const Vector2& hit : now.hits) {
    for (const Vector2& former : place.hits) {
      if ((hit - former).squaredNorm() < kDepartureGap_m * kDepartureGap_m) return false;
    }
  }
  return hides(now, centre, place.centre) || is_free(place.hits, beams);
}

}  // namespace mocha
