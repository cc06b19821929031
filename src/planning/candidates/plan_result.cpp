#include "planning/candidates/plan_result.h"

namespace mocha {

const char* to_text(PlanReason reason) {
  switch (reason) {
    case PlanReason::kSolved:
      return "solved";
    case PlanReason::kNoGoal:
      return "no goal";
    case PlanReason::kNoMap:
      return "no map";
    case PlanReason::kNoPose:
      return "no pose";
    case PlanReason::kInvalidInput:
      return "invalid input";
    case PlanReason::kStartOccupied:
      return "start occupied";
    case PlanReason::kGoalOccupied:
      return "goal occupied";
    case PlanReason::kNoPath:
      return "no path";
    case PlanReason::kNotCertified:
      return "not certified";
    case PlanReason::kBudgetExhausted:
      return "budget exhausted";
    case PlanReason::kPeerConflict:
      return "peer conflict";
    case PlanReason::kBraking:
      return "braking";
    case PlanReason::kCannotWin:
      return "cannot win";
    case PlanReason::kEmergencyStop:
      return "emergency stop";
    case PlanReason::kPaused:
      return "paused";
  }
  return "unknown";
}

std::string outcome(const PlanCandidate& candidate) {
  return candidate.violation ? describe(candidate.violation) : to_text(candidate.reason);
}

}  // namespace mocha
