#pragma once

#include <vector>

#include "perception/localization/branch_and_bound_matcher.h"
#include "perception/pose_graph/surfel_map.h"

namespace mocha {

/// How well keyframes agree with a place that they may have come back to.
struct LoopMatch {
  Alignment place;       ///< of the first of the keyframes
  double quality = 0.0;  ///< share of their hits that the place explains, of those it says
                         ///< anything about; 0 where nothing was found
  double rival = 0.0;    ///< the same of the next best place
};

/// Where in the window the first of `seen` may stand, all of them together, among what the
/// keyframes `place` saw. None of either are the same; both lists have an element.
LoopMatch match_loop(const std::vector<PlacedKeyframe>& seen,
                     const std::vector<PlacedKeyframe>& place, const SearchWindow& window);

}  // namespace mocha
