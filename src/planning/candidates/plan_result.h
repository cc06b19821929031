#pragma once

#include <string>
#include <vector>

#include "optimization/trajectory_objective.h"
#include "planning/candidates/fallback.h"
#include "safety/certificate.h"
#include "safety/requirement.h"
#include "topology/signatures/h_signature.h"
#include "trajectory/motion.h"

namespace mocha {

/// Why planning ended as it did; the same list as in PlannerStatus.msg.
enum class PlanReason {
  kSolved = 0,
  kNoGoal = 1,
  kNoMap = 2,
  kNoPose = 3,
  kInvalidInput = 4,
  kStartOccupied = 5,
  kGoalOccupied = 6,
  kNoPath = 7,
  kNotCertified = 8,
  kBudgetExhausted = 9,
  kPeerConflict = 10,
  kBraking = 11,
  kCannotWin = 12,
  kEmergencyStop = 13,
  kPaused = 14
};

/// In a word or two, such as "goal occupied".
const char* to_text(PlanReason reason);

/// One path that was optimised, certified or not.
struct PlanCandidate {
  Signature signature;
  PlanReason reason = PlanReason::kNotCertified;
  RequirementName met = RequirementName::kNone;  ///< by the motion, the most demanding
  Violation violation;                           ///< of what was wanted, where that is not met
  double cost = 0.0;  ///< J, paper (14), and what comes before and after the drive
  CostTerms terms;    ///< sum up to the cost
  Parameterisation parameterisation = Parameterisation::kNone;  ///< of the motion
  std::vector<Fallback> fallbacks;                              ///< the same
  int evaluations = 0;
  double work = 0.0;          ///< evaluations of single pieces
  std::vector<Vector2> path;  ///< of the front end, from which the optimisation started
  Motion motion;
  double drive_ends_s = 0.0;  ///< absolute: there, a local plan is back on the plan that it left
  bool driven = false;  ///< began on a path of the class that is being driven; at most one does
  bool selected = false;
};

/// What became of a candidate: the first violation in words, if any, else the reason.
std::string outcome(const PlanCandidate& candidate);

/// What was selected among candidates, or why nothing.
struct Selection {
  PlanReason reason = PlanReason::kNoPath;  ///< kSolved: there is a motion that is certified
  std::string message;                      ///< the same for a human
  Violation violation;                      ///< of the first candidate, where none is certified
  Motion motion;                            ///< empty unless solved
  /// The motion is of another class than what is being driven.
  bool switches_class = false;
  std::vector<PlanCandidate> candidates;  ///< one of each class
};

/// A plan to the goal.
struct PlanResult : Selection {
  /// Where it leads: the goal, or the nearest free place; valid where solved.
  Vector2 goal = Vector2::Zero();
  double took_s = 0.0;  ///< of planning, where it was measured
};

}  // namespace mocha
