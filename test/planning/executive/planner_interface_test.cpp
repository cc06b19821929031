#include "planning/executive/planner_interface.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

/// What becomes of a failure of that kind, for a robot that can back out.
PlanResult instead_of(PlanReason reason, const Motion& committed, bool can_back_out) {
  PlanQuery query;
  query.committed = committed;
  query.start_time_s = 4.0;
  PlannerInterface planner;
  planner.back_out = [&](const PlanQuery& asked) -> std::optional<Motion> {
    if (!can_back_out) return std::nullopt;
    return standing(asked.start_time_s, {-1.0, 0.0}, 0.0);
  };
  PlanResult result;
  result.reason = reason;
  result.message = "no path";
  back_out_instead(query, planner, result);
  return result;
}

const Motion kRest = standing(0.0, {0.0, 0.0}, 0.0);

TEST(PlannerInterface, BacksOutFromRestWhereThereIsNoWay) {
  for (const auto reason :
       {PlanReason::kNoPath, PlanReason::kNotCertified, PlanReason::kBudgetExhausted}) {
    const PlanResult result = instead_of(reason, kRest, true);
    EXPECT_EQ(result.reason, PlanReason::kBackingOut);
    EXPECT_EQ(result.motion.start_time(), 4.0);
    EXPECT_EQ(result.message.find("no path"), 0u);
  }
}

TEST(PlannerInterface, AFailureStaysOneWhereBackingOutHelpsNothing) {
  for (const auto reason : {PlanReason::kPeerConflict, PlanReason::kGoalOccupied,
                            PlanReason::kStartOccupied, PlanReason::kInvalidInput}) {
    const PlanResult result = instead_of(reason, kRest, true);
    EXPECT_EQ(result.reason, reason);
    EXPECT_TRUE(result.motion.empty());
  }
}

TEST(PlannerInterface, AFailureStaysOneWhereTheRobotMovesOrCannotBackOut) {
  EXPECT_EQ(instead_of(PlanReason::kNoPath, long_drive(0.0, 20.0), true).reason,
            PlanReason::kNoPath);
  EXPECT_EQ(instead_of(PlanReason::kNoPath, kRest, false).reason, PlanReason::kNoPath);
}

}  // namespace
}  // namespace mocha
