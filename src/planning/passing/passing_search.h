#pragma once

#include <functional>

#include "planning/passing/passing_problem.h"

namespace mocha {

/// Some way in which all robots get to their goals: lazy constraints addition search (Okumura,
/// LaCAM, AAAI 2023). Complete: finds a sequence if there is one, within `most_steps` that may be
/// looked at. Deterministic. Throws std::invalid_argument for what is no problem, and for more
/// robots than JointStep allows.
PassingSequence find_passing(
    const PassingProblem& problem, int most_steps,
    const std::function<bool()>& should_stop = [] { return false; });

}  // namespace mocha
