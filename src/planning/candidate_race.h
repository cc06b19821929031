#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "planning/candidate_planner.h"

namespace mocha {

/// Optimises all approaches in parallel. Returns a candidate for each, in the same order.
///
/// A candidate is stopped (kCannotWin) as soon as what it must cost at least, by the least length
/// of its class, is not below what another one has been certified with; so the cheapest is the same
/// however many threads there are. The candidate of the class that is driven runs to its end, as
/// the others are measured against it: they must be cheaper by the share `switch_margin`.
/// `should_stop` may be called by several threads at once.
std::vector<PlanCandidate> race(const CandidatePlanner& planner, const PlanQuery& query,
                                const Approaches& approaches, const PlanningScene& scene,
                                const PlannerRules& rules,
                                const std::function<bool()>& should_stop);

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
