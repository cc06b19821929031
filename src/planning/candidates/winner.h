#pragma once

#include <algorithm>
#include <vector>

#include "planning/candidates/plan_result.h"

namespace mocha {

/// Index of the one to be driven: the cheapest certified one, but that of the class that is being
/// driven if no other is cheaper by the share `switch_margin` of its cost and by `least_gain`. -1
/// if none is certified.
template <typename Candidate>
int winner(const std::vector<Candidate>& candidates, double switch_margin,
           double least_gain = 0.0) {
  int best = -1;
  int driven = -1;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].reason != PlanReason::kSolved) continue;
    if (best < 0 || candidates[i].cost < candidates[best].cost) best = static_cast<int>(i);
    if (candidates[i].driven) driven = static_cast<int>(i);
  }
  if (driven < 0) return best;
  const double to_beat = std::min((1.0 - switch_margin) * candidates[driven].cost,
                                  candidates[driven].cost - least_gain);
  return candidates[best].cost >= to_beat ? driven : best;
}

}  // namespace mocha
