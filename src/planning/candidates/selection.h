#pragma once

#include <algorithm>

#include "planning/candidates/plan_result.h"

namespace mocha {

/// By how much another class than the one that is being driven has to be cheaper.
struct SwitchRule {
  double margin;      ///< a share of the cost of what is driven
  double least_gain;  ///< and at least so much

  /// What costs less is worth a switch.
  double to_beat(double driven_cost) const {
    return std::min((1.0 - margin) * driven_cost, driven_cost - least_gain);
  }
};

/// Selects, among the candidates that meet the most, the cheapest, but that of the class that is
/// being driven if no other is worth a switch; or says of the first one why it is none. The other
/// candidates count as not certified. Returns what was selected, or null.
const PlanCandidate* select(const SwitchRule& rule, Selection& selection);

}  // namespace mocha
