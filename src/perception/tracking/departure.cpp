#include "perception/tracking/departure.h"

#include <algorithm>
#include <cmath>

#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

constexpr double kMostFormer = 0.5;       // of the former hits
constexpr std::size_t kMostLookedAt = 8;  // that are looked at
constexpr double kBesideBeam_m = 0.075;   // a beam so near to a place tells whether that is free
constexpr double kBeyond_m = 0.15;        // it passes if it ends so much farther away

/// Returns taken where some beams end there, as at a slanted wall; free where all that lead there
/// pass.
View view_at(const Vector2& place, const std::vector<Beam>& beams) {
  int passing = 0;
  int there = 0;
  int all = 0;
  for (const Beam& beam : beams) {
    const Vector2 to = place - beam.origin.head<2>();
    const Vector2 ray = (beam.end - beam.origin).head<2>();
    const double length_m = ray.norm();
    const double along_m = to.dot(ray) / length_m;
    const double off_m = std::abs(cross(to, ray)) / length_m;
    if (!(along_m > 0.0 && off_m < kBesideBeam_m)) continue;  // also a length that is not finite
    ++all;
    passing += length_m >= along_m + kBeyond_m ? 1 : 0;
    there += std::abs(length_m - along_m) < kBeyond_m ? 1 : 0;
  }
  if (all == 0) return View::kUnseen;
  if (there > 0) return View::kTaken;
  return passing == all ? View::kFree : View::kHidden;
}

/// Returns free or taken where half of these places are, and unseen where neither.
View view_of_most(const std::vector<Vector2>& places, const std::vector<Beam>& beams) {
  const std::size_t step = (places.size() + kMostLookedAt - 1) / kMostLookedAt;
  int looked_at = 0;
  int free = 0;
  int taken = 0;
  for (std::size_t i = 0; i < places.size(); i += step) {
    const View view = view_at(places[i], beams);
    ++looked_at;
    free += view == View::kFree ? 1 : 0;
    taken += view == View::kTaken ? 1 : 0;
  }
  if (free >= kMostFormer * looked_at) return View::kFree;
  return taken >= kMostFormer * looked_at ? View::kTaken : View::kUnseen;
}

bool hides(const Detection& now, const Vector2& centre, const Vector2& place) {
  const Vector2 to = place - now.sensor;
  const double middle_rad = 0.5 * (now.right_rad + now.left_rad);
  const double off_rad = std::remainder(std::atan2(to.y(), to.x()) - middle_rad, 2.0 * M_PI);
  return std::abs(off_rad) < 0.5 * (now.left_rad - now.right_rad) &&
         (centre - now.sensor).norm() + kBeyond_m < to.norm();
}

}  // namespace

Departure departure(const SeenPlace& place, const Detection& now, const Vector2& centre,
                    const std::vector<Beam>& beams) {
  for (const Vector2& hit : now.hits) {
    for (const Vector2& former : place.hits) {
      if ((hit - former).squaredNorm() < kDepartureGap_m * kDepartureGap_m) return Departure::kNone;
    }
  }
  if (hides(now, centre, place.centre)) return Departure::kLeft;
  const View view = view_of_most(place.hits, beams);
  if (view == View::kFree) return Departure::kLeft;
  return view == View::kUnseen ? Departure::kUntold : Departure::kNone;
}

}  // namespace mocha
