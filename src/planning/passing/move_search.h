#pragma once

#include <functional>

#include "planning/passing/passing_problem.h"

namespace mocha {

struct MoveSearchOptions {
  int most_placings;         ///< that are looked at: memory and time
  double times_least = 1.0;  ///< at most so much more is driven than need be; 1 or above. What is
                             ///< above finds a way sooner
};

/// How the robots get to their goals by moving one by one, so that they drive little, all together
/// (weighted A*: Pohl, 1970). Complete, and quick where the robots are few or the places are: there
/// are as many states as ways to place the robots. Throws std::invalid_argument for options out of
/// range.
PassingSequence find_few_moves(
    const PassingProblem& problem, const MoveSearchOptions& options,
    const std::function<bool()>& should_stop = [] { return false; });

}  // namespace mocha
