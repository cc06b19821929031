#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planning/passing/passing_problem.h"

namespace mocha {

/// How some robots can get to their goals while the others do in each step of a sequence what they
/// did: the way that costs least (A*, one robot after the other: Standley, operator decomposition,
/// AAAI 2010). A step costs what the farthest of those that move drives, and a tenth of what all
/// drive.
class PartialSearch {
 public:
  static constexpr int kMostTogether = 6;

  /// Must not outlive the problem.
  explicit PartialSearch(const PassingProblem& problem);

  /// The sequence with the best moves of `robots`, at most kMostTogether. `left` counts down the
  /// choices that are looked at. In each variant but the first, some moves count as somewhat
  /// longer: what is as good otherwise differs.
  PassingSequence run(const std::vector<JointStep>& steps, const std::vector<int>& robots,
                      std::uint32_t variant, int& left,
                      const std::function<bool()>& should_stop) const;

 private:
  const PassingProblem& problem_;
  const GoalDistances distances_m_;
};

}  // namespace mocha
