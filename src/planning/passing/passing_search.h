#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planning/passing/joint_step.h"

namespace mocha {

/// Who is where, and who is to get where.
struct PassingProblem {
  static constexpr int kAnywhere = -1;

  PlaceGraph graph;
  Placing starts;
  Placing goals;  ///< kAnywhere: the robot has no goal, and makes room as it likes
};

struct PassingSequence {
  enum class Outcome {
    kFound,
    kImpossible,  ///< whatever the robots do: all that they can do was looked at
    kStopped,     ///< the effort, or the caller, ended it
  };
  Outcome outcome = Outcome::kStopped;
  std::vector<JointStep> steps;  ///< from the starts to the goals; their graph is the problem's
};

/// How all robots get to their goals: lazy constraints addition search, with an improvement of the
/// first solution for a while (Okumura, LaCAM, AAAI 2023 and IJCAI 2023). Complete: finds a
/// sequence if there is one, given enough steps. Deterministic; each `variant` prefers others of
/// what is as good. What is improved is the distance over which the farthest driver of each step
/// drives, summed, with a tenth of what all drive. `left` counts down the steps that may be looked
/// at. Throws std::invalid_argument where starts and goals are not of as many robots, or not of the
/// graph, or more than JointStep allows.
PassingSequence find_passing(
    const PassingProblem& problem, std::uint32_t variant, int& left,
    const std::function<bool()>& should_stop = [] { return false; });

}  // namespace mocha
