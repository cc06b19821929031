#pragma once

#include <functional>

#include "planning/passing/passing_problem.h"

namespace mocha {

/// How the robots get to their goals by moving one by one, so that they drive as little as can be,
/// all together (A*). Complete, and quick where the robots are few or the places are: there are as
/// many states as ways to place the robots. Looks at `most_moves` at most.
PassingSequence find_fewest_moves(
    const PassingProblem& problem, int most_moves,
    const std::function<bool()>& should_stop = [] { return false; });

}  // namespace mocha
