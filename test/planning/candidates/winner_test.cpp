#include "planning/candidates/winner.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

PlanCandidate candidate(double cost, bool driven, PlanReason reason = PlanReason::kSolved) {
  PlanCandidate result;
  result.cost = cost;
  result.driven = driven;
  result.reason = reason;
  return result;
}

TEST(Winner, IsTheCheapestOfThoseThatAreCertified) {
  EXPECT_EQ(winner<PlanCandidate>({}, 0.1), -1);
  EXPECT_EQ(winner<PlanCandidate>({candidate(1.0, false, PlanReason::kNotCertified)}, 0.1), -1);
  EXPECT_EQ(winner<PlanCandidate>({candidate(1.0, false, PlanReason::kCannotWin),
                                   candidate(3.0, false), candidate(2.0, false)},
                                  0.1),
            2);
}

TEST(Winner, IsOfTheClassThatIsDrivenUnlessAnotherIsCheaperByTheMargin) {
  EXPECT_EQ(winner<PlanCandidate>({candidate(9.1, false), candidate(10.0, true)}, 0.1), 1);
  EXPECT_EQ(winner<PlanCandidate>({candidate(8.9, false), candidate(10.0, true)}, 0.1), 0);
  EXPECT_EQ(winner<PlanCandidate>({candidate(9.9, false), candidate(10.0, true)}, 0.0), 0);
  EXPECT_EQ(winner<PlanCandidate>(
                {candidate(8.0, false), candidate(7.0, true, PlanReason::kNotCertified)}, 0.1),
            0);
}

}  // namespace
}  // namespace mocha
