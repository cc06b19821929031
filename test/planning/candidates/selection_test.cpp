#include "planning/candidates/selection.h"

#include <gtest/gtest.h>

#include <limits>

namespace mocha {
namespace {

PlanCandidate candidate(double cost, bool driven, PlanReason reason = PlanReason::kSolved,
                        RequirementName met = RequirementName::kDetour) {
  PlanCandidate result;
  result.cost = cost;
  result.driven = driven;
  result.reason = reason;
  result.met = reason == PlanReason::kSolved ? met : RequirementName::kNone;
  return result;
}

/// The index of the one that is selected; -1 for none.
int winner(std::vector<PlanCandidate> candidates, double margin, double least_gain = 0.0) {
  Selection selection;
  selection.candidates = std::move(candidates);
  const PlanCandidate* chosen = select({margin, least_gain}, selection);
  if (!chosen) return -1;
  EXPECT_EQ(selection.reason, PlanReason::kSolved);
  for (const PlanCandidate& each : selection.candidates) EXPECT_EQ(each.selected, &each == chosen);
  return static_cast<int>(chosen - selection.candidates.data());
}

TEST(Selection, IsTheCheapestOfThoseThatAreCertified) {
  EXPECT_EQ(winner({}, 0.1), -1);
  EXPECT_EQ(winner({candidate(1.0, false, PlanReason::kNotCertified)}, 0.1), -1);
  EXPECT_EQ(winner({candidate(1.0, false, PlanReason::kCannotWin), candidate(3.0, false),
                    candidate(2.0, false)},
                   0.1),
            2);
}

TEST(Selection, WhatMeetsMoreIsSelectedThoughItIsDearer) {
  Selection selection;
  selection.candidates = {candidate(1.0, true, PlanReason::kSolved, RequirementName::kDetourLikely),
                          candidate(9.0, false, PlanReason::kSolved, RequirementName::kDetour)};
  EXPECT_EQ(select({0.1, 0.0}, selection), &selection.candidates[1]);
  EXPECT_EQ(selection.candidates[0].reason, PlanReason::kNotCertified);
}

TEST(Selection, SaysOfTheFirstCandidateWhyThereIsNone) {
  Selection selection;
  selection.candidates = {candidate(1.0, false, PlanReason::kNotCertified),
                          candidate(2.0, false, PlanReason::kBudgetExhausted)};
  Violation& violation = selection.candidates[0].violation;
  violation.term = ViolatedTerm::kSpeed;
  EXPECT_FALSE(select({0.1, 0.0}, selection));
  EXPECT_EQ(selection.reason, PlanReason::kNotCertified);
  EXPECT_EQ(selection.message, describe(violation));
  EXPECT_TRUE(selection.violation);
}

TEST(Selection, IsOfTheClassThatIsDrivenUnlessAnotherIsCheaperByTheMargin) {
  EXPECT_EQ(winner({candidate(9.1, false), candidate(10.0, true)}, 0.1), 1);
  EXPECT_EQ(winner({candidate(8.9, false), candidate(10.0, true)}, 0.1), 0);
  EXPECT_EQ(winner({candidate(9.9, false), candidate(10.0, true)}, 0.0), 0);
  EXPECT_EQ(winner({candidate(8.0, false), candidate(7.0, true, PlanReason::kNotCertified)}, 0.1),
            0);
}

TEST(Selection, NearZeroASwitchHasToGainSomething) {
  EXPECT_EQ(winner({candidate(1.0, false), candidate(10.0, true)}, 0.1, 9.5), 1);
  EXPECT_EQ(winner({candidate(0.4, false), candidate(10.0, true)}, 0.1, 9.5), 0);
}

}  // namespace
}  // namespace mocha
