#include "planning/candidates/plan_result.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

TEST(PlanResult, TheOutcomeOfACandidateIsItsViolationElseItsReason) {
  PlanCandidate candidate;
  candidate.reason = PlanReason::kCannotWin;
  EXPECT_EQ(outcome(candidate), "cannot win");
  candidate.violation.term = ViolatedTerm::kYawRate;
  EXPECT_EQ(outcome(candidate), describe(candidate.violation));
}

}  // namespace
}  // namespace mocha
