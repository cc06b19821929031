#include "perception/tracking/legs.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr std::size_t kHits = 3;  // on a leg, at least
constexpr double kNarrowest_m = 0.03;
constexpr double kWidest_m = 0.22;      // with clothes
constexpr double kClosest_m = 0.12;     // between the middles of two legs ...
constexpr double kFarthestLeg_m = 0.5;  // ... of a person that walks

bool is_leg(const ScanSegment& segment) {
  return segment.stands_free && segment.hits.size() >= kHits && segment.width_m >= kNarrowest_m &&
         segment.width_m <= kWidest_m;
}

struct Pair {
  double apart_m;
  std::size_t one;
  std::size_t other;
};

/// The closest first.
std::vector<Pair> pairs_of(const std::vector<Vector2>& middles) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    for (std::size_t j = i + 1; j < middles.size(); ++j) {
      const double apart_m = (middles[i] - middles[j]).norm();
      if (apart_m >= kClosest_m && apart_m <= kFarthestLeg_m) pairs.push_back({apart_m, i, j});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.apart_m < b.apart_m; });
  return pairs;
}

}  // namespace

std::vector<LegHits> find_legs(const std::vector<Beam>& beams,
                               const std::vector<ScanSegment>& segments) {
  std::vector<LegHits> legs;
  std::vector<Vector2> middles;
  for (const ScanSegment& segment : segments) {
    if (!is_leg(segment)) continue;
    legs.push_back({segment.hits, 1});
    middles.push_back(segment.middle(beams));
  }
  for (const Pair& pair : pairs_of(middles)) {
    LegHits& one = legs[pair.one];
    LegHits& other = legs[pair.other];
    if (one.legs != 1 || other.legs != 1) continue;
    one.hits.insert(one.hits.end(), other.hits.begin(), other.hits.end());
    one.legs = 2;
    other.legs = 0;
  }
  legs.erase(std::remove_if(legs.begin(), legs.end(), [](const LegHits& l) { return l.legs == 0; }),
             legs.end());
  for (LegHits& leg : legs) std::sort(leg.hits.begin(), leg.hits.end());
  return legs;
}

}  // namespace mocha
