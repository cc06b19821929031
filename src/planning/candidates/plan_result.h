#pragma once

#include <string>
#include <vector>

#include "optimization/trajectory_objective.h"
#include "safety/certificate.h"
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
  kBackingOut = 12,
  kCannotWin = 13,
  kEmergencyStop = 14
};

/// One path to the goal that was optimised, certified or not.
struct PlanCandidate {
  Signature signature;
  PlanReason reason = PlanReason::kNotCertified;
  Violation violation;  ///< where `reason` is kNotCertified
  double cost = 0.0;    ///< J, paper (14), and the time of what comes before and after the drive
  CostTerms terms;      ///< sum up to the cost
  int evaluations = 0;
  std::vector<Vector2> path;  ///< of the front end, from which the optimisation started
  Motion motion;
  bool driven = false;  ///< began on a path of the class that is being driven; at most one does
  bool selected = false;
};

struct PlanResult {
  PlanReason reason = PlanReason::kNoPath;
  std::string message;  ///< the same for a human
  Violation violation;
  Motion motion;  ///< certified; empty unless solved, or where the goal executive backs out
  Vector2 goal =
      Vector2::Zero();  ///< where it leads: the goal, or the nearest free place; valid where solved
  /// The motion is of another class than the plan that is being driven.
  bool switches_class = false;
  std::vector<PlanCandidate> candidates;  ///< one of each class
};

}  // namespace mocha
