#pragma once

#include <limits>
#include <vector>

#include "perception/localization/branch_and_bound_matcher.h"
#include "perception/pose_graph/surfel_map.h"

namespace mocha {

/// How well keyframes agree with a place that they may have come back to.
struct LoopMatch {
  Alignment place;       ///< of the first of the keyframes
  double known = 0.0;    ///< share of their hits of which the place says anything
  double quality = 0.0;  ///< share of their hits that the place explains, of those it says
                         ///< anything about
};

/// Matches that explain so much less than the best one are no rivals of it.
constexpr double kMatchRivalry = 0.1;

/// Positions of keyframes that are known so well, as seen from another, are matched together.
constexpr double kTogetherSigma_m = 0.16;

/// A keyframe and those around it that are looked for with it, itself first.
std::vector<int> seen_together(int keyframe, const PoseGraph& graph);

/// Finds keyframes again among what others saw of a place.
class LoopMatcher {
 public:
  /// Of the place, what is seen no farther than `reach_m` from the first of its keyframes along
  /// each axis. They must outlive this; there must be one.
  explicit LoopMatcher(std::vector<PlacedKeyframe> place,
                       double reach_m = std::numeric_limits<double>::infinity());

  /// Where in the window the first of `seen` may stand, all of them together: at least one, and
  /// none of those that saw the place. The best first, no two of them the same.
  std::vector<LoopMatch> match(const std::vector<PlacedKeyframe>& seen,
                               const SearchWindow& window) const;

  /// The same for where they are expected to be.
  LoopMatch match_near(const std::vector<PlacedKeyframe>& seen, const Pose& expected) const;

 private:
  LoopMatch judged(const std::vector<PlacedKeyframe>& seen, const std::vector<Surfel>& surfels,
                   const Pose& expected) const;

  SurfelMap surfels_;
  LikelihoodField walls_;
  BranchAndBoundMatcher search_;
};

}  // namespace mocha
