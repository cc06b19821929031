#pragma once

#include <functional>
#include <vector>

#include "planning/global/candidate_planner.h"

namespace mocha {

/// Optimises all seeds in parallel. Returns a candidate for each, in the same order.
///
/// A candidate is stopped (kCannotWin) as soon as what it must cost at least, by the least length
/// of its class, is not below what another one has been certified with; so the cheapest is the same
/// however many threads there are. The candidate of the class that is driven runs to its end, as
/// the others are measured against it: they must be cheaper by the share `switch_margin`.
/// `should_stop` may be called by several threads at once.
std::vector<PlanCandidate> race(const CandidatePlanner& planner, const PlanQuery& query,
                                const CandidateSeeds& seeds, const PlanningScene& scene,
                                const PlannerOptions& options,
                                const std::function<bool()>& should_stop);

}  // namespace mocha
