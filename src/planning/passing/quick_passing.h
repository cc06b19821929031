#pragma once

#include <functional>
#include <vector>

#include "planning/passing/passing_duration.h"
#include "planning/passing/passing_problem.h"

namespace mocha {

/// A sequence that takes less time than the one given, or that one: the moves of each robot, then
/// of these and of those are found anew among those of the others (PartialSearch), and kept where
/// that is no slower (large neighbourhood search: Li et al., MAPF-LNS, IJCAI 2021), as long as
/// `left` lasts, the choices that may be looked at. Deterministic.
std::vector<JointStep> quickened(const PassingProblem& problem, std::vector<JointStep> sequence,
                                 const PassingPace& pace, int left,
                                 const std::function<bool()>& should_stop);

}  // namespace mocha
