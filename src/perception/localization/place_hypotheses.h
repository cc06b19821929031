#pragma once

#include <algorithm>
#include <vector>

#include "perception/localization/scan_matcher.h"

namespace mocha {

/// A place where the robot may be.
struct PlaceHypothesis {
  PoseEstimate base;
  double quality;          ///< share of the scans that the map explains there
  double proved_s;         ///< when it has been tried for long enough
  bool carried = false;    ///< the robot must have been, to be there
  bool confirmed = false;  ///< found more than once, or expected
  bool known = false;      ///< has been believed
  bool believed = false;
  bool doubted = false;  ///< explained next to nothing since it was believed
};

/// All places where the robot may be.
///
/// A place is given up when another one explains clearly more. One that has been believed yields
/// only to a place that was tried, and only by far to one that the odometry cannot have led to;
/// until it explains next to nothing: then the odometry's word counts no more than any other.
class PlaceHypotheses {
 public:
  struct Options {
    double good_quality;  ///< needed to be believed
    double poor_quality;  ///< needed to be kept
    double rivalry;       ///< a place that is worse by less is a rival
  };

  explicit PlaceHypotheses(const Options& options) : options_(options) {}

  void add(const PlaceHypothesis& place) { places_.push_back(place); }
  void clear() { places_.clear(); }

  /// Merges those that have become one place, drops those without a chance, and puts the likeliest
  /// first. Returns whether a doubted place was dropped.
  bool sift(double time_s);

  /// Drops those for which `is_lost(place)` holds.
  template <class IsLost>
  void drop(IsLost is_lost) {
    places_.erase(std::remove_if(places_.begin(), places_.end(), is_lost), places_.end());
  }

  /// Believes the likeliest place if nothing is left to be said against it. Returns whether it has
  /// just begun to.
  bool believe(double time_s);

  /// Whether the likeliest place is believed, and none is clearly better.
  bool is_certain() const;

  /// Whether the place that was believed explained next to nothing since.
  bool is_doubted() const;

  bool empty() const { return places_.empty(); }
  const std::vector<PlaceHypothesis>& all() const { return places_; }
  std::vector<PlaceHypothesis>& all() { return places_; }  ///< to be moved and judged anew

 private:
  bool is_beaten(const PlaceHypothesis& place, double tried_until_s) const;
  void merge(PlaceHypothesis& kept, const PlaceHypothesis& other) const;

  Options options_;
  std::vector<PlaceHypothesis> places_;
};

}  // namespace mocha
