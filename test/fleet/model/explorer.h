#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fleet/model/protocol_model.h"

namespace mocha::test {

struct Exploration {
  std::size_t states = 0;
  std::size_t transitions = 0;
  std::size_t settled = 0;                  ///< states in which a motion has been settled
  int depth = 0;                            ///< actions from the beginning to the last state
  bool complete = false;                    ///< there are no other states
  std::string violation;                    ///< empty: both properties hold in all states
  std::vector<std::string> counterexample;  ///< the fewest actions that lead to a violation
};

/// Looks at all states that a scenario can come to, breadth first, until one violates a property or
/// there are too many.
Exploration explore(const Scenario& scenario, std::size_t most_states);

/// The figures in a line, and the counterexample, an action a line.
std::string to_text(const Exploration& exploration);

}  // namespace mocha::test
