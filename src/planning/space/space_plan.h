#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "optimization/trajectory_objective.h"
#include "planning/candidates/fallback.h"
#include "planning/candidates/plan_result.h"
#include "safety/violation.h"
#include "topology/signatures/h_signature.h"
#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// One path in space that was optimised, certified or not.
struct SpaceCandidate {
  std::vector<Eigen::Vector3d> path;  ///< of the front end
  Signature signature;                ///< of the curve
  PlanReason reason = PlanReason::kNotCertified;
  BasicViolation<3> violation;  ///< of what was to be proved
  double cost = 0.0;            ///< J, paper (14)
  CostTerms terms;              ///< sum up to the cost
  Parameterisation parameterisation = Parameterisation::kNone;
  std::optional<BasicFallback<3>> fallback;  ///< why it is not camouflage
  int evaluations = 0;
  PiecewisePolynomial<3, 3> curve;  ///< from rest to rest; empty where there is none
};

/// In a few words: solved, what is violated, or why there is no curve.
std::string outcome(const SpaceCandidate& candidate);

/// What planning in space gives: candidates of pairwise different classes, cheapest certified
/// first.
struct SpacePlan {
  PlanReason reason = PlanReason::kNoMap;
  std::string message;  ///< the same in a sentence
  std::vector<SpaceCandidate> candidates;
  double took_s = 0.0;  ///< searching and optimising

  /// The cheapest certified candidate, or null.
  const SpaceCandidate* selected() const {
    return reason == PlanReason::kSolved ? &candidates.front() : nullptr;
  }
};

}  // namespace mocha
