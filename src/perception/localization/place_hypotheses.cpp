#include "perception/localization/place_hypotheses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {
namespace {

constexpr double kSamePlace_m = 0.2;
constexpr double kSamePlace_rad = 0.2;
constexpr double kHopeless = 0.6;  // so much of what is poor ends the trust in the odometry
constexpr double kCarried = 4.0;   // so many times the rivalry shows that the robot was carried

bool is_same(const Pose& a, const Pose& b) {
  return (a.position - b.position).norm() < kSamePlace_m &&
         std::abs(wrap_angle(a.yaw_rad - b.yaw_rad)) < kSamePlace_rad;
}

bool is_likelier(const PlaceHypothesis& a, const PlaceHypothesis& b) {
  if (a.believed != b.believed) return a.believed;
  return a.carried != b.carried ? b.carried : a.quality > b.quality;
}

}  // namespace

/// Whether another place, tried by then, is clearly better.
bool PlaceHypotheses::is_beaten(const PlaceHypothesis& place, double tried_until_s) const {
  return std::any_of(places_.begin(), places_.end(), [&](const PlaceHypothesis& other) {
    const double margin = options_.rivalry * (other.carried && !place.carried ? kCarried : 1.0);
    return other.proved_s <= tried_until_s && other.quality > place.quality + margin;
  });
}

void PlaceHypotheses::merge(PlaceHypothesis& kept, const PlaceHypothesis& other) const {
  const bool is_found_again =
      kept.proved_s != other.proved_s &&
      other.quality >= std::min(options_.good_quality, kept.quality - options_.rivalry);
  kept.confirmed = kept.confirmed || other.confirmed || is_found_again;
  kept.proved_s = std::min(kept.proved_s, other.proved_s);
  kept.known = kept.known || other.known;
  kept.believed = kept.believed || other.believed;
  kept.doubted = kept.doubted || other.doubted;
  kept.carried = kept.carried && other.carried;
}

bool PlaceHypotheses::sift(double time_s) {
  for (PlaceHypothesis& place : places_) {
    const double poor = options_.poor_quality;
    if (place.quality < poor) place.believed = false;
    if (place.known && place.quality < kHopeless * poor) place.doubted = true;
  }
  const bool was_doubted = is_doubted();
  if (was_doubted) {
    for (PlaceHypothesis& place : places_) place.carried = false;
  }
  std::stable_sort(places_.begin(), places_.end(), is_likelier);
  std::vector<PlaceHypothesis> kept;
  for (const PlaceHypothesis& place : places_) {
    if (place.quality < options_.poor_quality && !place.known) continue;
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const PlaceHypothesis& other) {
      return is_same(place.base.pose, other.base.pose);
    });
    if (same != kept.end()) {
      merge(*same, place);
    } else if (!is_beaten(place, place.known ? time_s : INFINITY)) {
      kept.push_back(place);
    }
  }
  places_ = std::move(kept);
  return was_doubted && !is_doubted();
}

bool PlaceHypotheses::is_doubted() const {
  return std::any_of(places_.begin(), places_.end(),
                     [](const PlaceHypothesis& place) { return place.doubted; });
}

bool PlaceHypotheses::believe(double time_s) {
  if (places_.empty()) return false;
  PlaceHypothesis& best = places_[0];
  const bool is_alone = places_.size() == 1 || (places_[1].carried && !best.carried);
  if (best.believed || !best.confirmed || !is_alone) return false;
  if (best.quality < options_.good_quality || best.proved_s > time_s) return false;
  best.known = best.believed = true;
  best.carried = best.doubted = false;
  return true;
}

bool PlaceHypotheses::is_certain() const {
  if (places_.empty() || !places_[0].believed || is_beaten(places_[0], INFINITY)) return false;
  return std::none_of(places_.begin(), places_.end(), [&](const PlaceHypothesis& other) {
    return other.confirmed && other.quality > places_[0].quality + options_.rivalry;
  });
}

}  // namespace mocha
