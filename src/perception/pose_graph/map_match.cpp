#include "perception/pose_graph/map_match.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "perception/pose_graph/loop_matcher.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kApart_m = 3.0;      // of the places that are looked for
constexpr double kLeastKnown = 0.7;   // share of a place that the map has to know
constexpr double kSameFrame_m = 0.5;  // frames that put a place so near are the same
constexpr double kSameFrame_rad = 0.1;
// How exactly a place tells where the others around it are: both maps may be bent.
constexpr double kReach_m = 15.0;
constexpr double kBend = 0.1;
constexpr double kBendRadPerMetre = 0.02;
constexpr double kPlaceAround_m = 0.3;
constexpr double kPlaceAround_rad = 0.06;
constexpr std::size_t kLeastAgreeing = 2;

/// Keyframes no two of which are near to each other.
std::vector<int> spread(const std::vector<Pose>& poses) {
  std::vector<int> result;
  for (int i = 0; i < static_cast<int>(poses.size()); ++i) {
    const bool is_near = std::any_of(result.begin(), result.end(), [&](int other) {
      return (poses[other].position - poses[i].position).norm() < kApart_m;
    });
    if (!is_near) result.push_back(i);
  }
  return result;
}

/// A place of the other map.
struct OtherPlace {
  int keyframe;
  Pose pose;
  std::vector<PlacedKeyframe> seen;
};

/// A way in which the maps may lie, and how well places of the other one then fit.
class Hypothesis {
 public:
  Hypothesis(const OtherPlace& place, const LoopMatch& match) { add(place, match); }

  void add(const OtherPlace& place, const LoopMatch& match) {
    found_.push_back({place.keyframe, match.place});
    poses_.push_back(place.pose);
    quality_ += match.quality;
  }

  void oppose(const LoopMatch& match) {
    quality_ += match.quality;
    ++opposed_;
  }

  /// How far a place of the other map is from those that were found.
  double far_m(const Pose& in_other) const {
    return (poses_[nearest(in_other)].position - in_other.position).norm();
  }

  /// Where a place of the other map has to be, as the nearest that was found is where it is.
  Pose expected(const Pose& in_other) const { return composed(frame(nearest(in_other)), in_other); }

  bool has(const OtherPlace& place, const LoopMatch& match) const {
    const Pose at = expected(place.pose);
    return (at.position - match.place.pose.position).norm() < kSameFrame_m &&
           std::abs(wrap_angle(at.yaw_rad - match.place.pose.yaw_rad)) < kSameFrame_rad;
  }

  /// Of the other map, by one of the places.
  Pose frame(std::size_t i) const {
    return composed(found_[i].place.pose, relative(poses_[i], Pose{}));
  }

  const std::vector<LoopClosure>& found() const { return found_; }
  double quality() const { return quality_ / static_cast<double>(found_.size() + opposed_); }

  bool is_good(double least_quality) const {
    return found_.size() >= kLeastAgreeing && quality() >= least_quality;
  }

  /// Whether this may be as true as another.
  bool rivals(const Hypothesis& other) const {
    return is_good(other.quality() - kMatchRivalry) && 2 * found_.size() >= other.found_.size();
  }

 private:
  std::size_t nearest(const Pose& in_other) const {
    std::size_t result = 0;
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      if ((poses_[i].position - in_other.position).norm() <
          (poses_[result].position - in_other.position).norm())
        result = i;
    }
    return result;
  }

  std::vector<LoopClosure> found_;
  std::vector<Pose> poses_;  // of these, in the other map
  double quality_ = 0.0;     // sum of all
  int opposed_ = 0;          // places where the other map does not fit
};

class MapSearch {
 public:
  MapSearch(const DrivenMap& map, const DrivenMap& other, double least_quality)
      : matcher_(all_of(map)), least_quality_(least_quality) {
    for (const int keyframe : spread(other.graph.poses()))
      places_.push_back(
          {keyframe, other.graph.poses()[keyframe],
           chosen(seen_together(keyframe, other.graph), other.graph, other.keyframes)});
  }

  std::vector<Hypothesis> hypotheses() const {
    std::vector<Hypothesis> result;
    for (const OtherPlace& place : places_) {
      const std::vector<LoopMatch> matches = matcher_.match(place.seen, {});
      for (const LoopMatch& match : matches) {
        const bool is_good = match.quality >= least_quality_ &&
                             match.quality >= matches.front().quality - kMatchRivalry;
        const bool is_known =
            std::any_of(result.begin(), result.end(),
                        [&](const Hypothesis& each) { return each.has(place, match); });
        if (is_good && !is_known) result.push_back(judged(place, match));
      }
    }
    return result;
  }

 private:
  static std::vector<PlacedKeyframe> all_of(const DrivenMap& map) {
    std::vector<int> all(map.keyframes.size());
    std::iota(all.begin(), all.end(), 0);
    return chosen(all, map.graph, map.keyframes);
  }

  /// From a place outwards.
  Hypothesis judged(const OtherPlace& first, const LoopMatch& match) const {
    Hypothesis result(first, match);
    std::vector<const OtherPlace*> places;
    for (const OtherPlace& place : places_) places.push_back(&place);
    const auto from_first_m = [&](const OtherPlace* place) {
      return (place->pose.position - first.pose.position).norm();
    };
    std::sort(places.begin(), places.end(),
              [&](auto a, auto b) { return from_first_m(a) < from_first_m(b); });
    for (const OtherPlace* place : places) {
      const double far_m = result.far_m(place->pose);
      if (place->keyframe == first.keyframe || far_m > kReach_m) continue;
      const LoopMatch here = match_at(*place, result.expected(place->pose), far_m);
      if (here.known < kLeastKnown) continue;
      if (here.quality < least_quality_) {
        result.oppose(here);
      } else {
        result.add(*place, here);
      }
    }
    return result;
  }

  LoopMatch match_at(const OtherPlace& place, const Pose& expected, double far_m) const {
    const std::vector<LoopMatch> found = matcher_.match(
        place.seen,
        {expected, kPlaceAround_m + kBend * far_m, kPlaceAround_rad + kBendRadPerMetre * far_m});
    if (!found.empty() && found.front().quality >= least_quality_) return found.front();
    return matcher_.match_near(place.seen, expected);
  }

  const LoopMatcher matcher_;
  const double least_quality_;
  std::vector<OtherPlace> places_;
};

}  // namespace

MapMatch match_maps(const DrivenMap& map, const DrivenMap& other,
                    const LoopCloserOptions& options) {
  MapMatch result;
  if (map.keyframes.empty() || other.keyframes.empty()) return result;
  const auto all = MapSearch(map, other, options.quality_of_several()).hypotheses();
  const auto support = [](const Hypothesis& each) { return each.found().size() * each.quality(); };
  const auto best = std::max_element(
      all.begin(), all.end(),
      [&](const Hypothesis& a, const Hypothesis& b) { return support(a) < support(b); });
  if (best == all.end() || !best->is_good(options.quality)) return result;
  const bool has_rival = std::any_of(all.begin(), all.end(), [&](const Hypothesis& each) {
    return &each != &*best && each.rivals(*best);
  });
  result.fault = has_rival ? MapMatch::Fault::kAmbiguous : MapMatch::Fault::kNone;
  result.frame = best->frame(0);
  result.found = best->found();
  return result;
}

}  // namespace mocha
