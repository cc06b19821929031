#include "planning/candidates/selection.h"

namespace mocha {
namespace {

std::string why_not(const PlanCandidate& candidate) {
  if (candidate.violation) return describe(candidate.violation);
  return candidate.reason == PlanReason::kBudgetExhausted
             ? "planning was stopped before a motion was found"
             : "the optimisation found no motion";
}

/// Of those that are solved; null if none is.
PlanCandidate* winner(std::vector<PlanCandidate>& candidates, const SwitchRule& rule) {
  PlanCandidate* best = nullptr;
  PlanCandidate* driven = nullptr;
  for (PlanCandidate& candidate : candidates) {
    if (candidate.reason != PlanReason::kSolved) continue;
    if (!best || candidate.cost < best->cost) best = &candidate;
    if (candidate.driven) driven = &candidate;
  }
  return driven && best->cost >= rule.to_beat(driven->cost) ? driven : best;
}

}  // namespace

const PlanCandidate* select(const SwitchRule& rule, Selection& selection) {
  RequirementName most = RequirementName::kNone;
  for (const PlanCandidate& each : selection.candidates) most = std::min(most, each.met);
  for (PlanCandidate& each : selection.candidates) {
    if (each.reason == PlanReason::kSolved && each.met != most)
      each.reason = PlanReason::kNotCertified;
  }
  PlanCandidate* chosen = winner(selection.candidates, rule);
  if (!chosen) {
    if (selection.candidates.empty()) return nullptr;
    const PlanCandidate& first = selection.candidates.front();
    selection.reason = first.reason;
    selection.violation = first.violation;
    selection.message = why_not(first);
    return nullptr;
  }
  chosen->selected = true;
  selection.reason = PlanReason::kSolved;
  selection.message = "solved";
  selection.violation = {};
  selection.motion = chosen->motion;
  return chosen;
}

}  // namespace mocha
