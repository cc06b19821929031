#include "planning/executive/back_out_instead.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

const std::vector<Vector2> kTrail = {{-2.0, 0.0}, {-1.5, 0.0}, {-1.0, 0.0}, {-0.5, 0.0}};

/// What becomes of a failure of that kind, for a robot that came along a trail.
PlanResult instead_of(PlanReason reason, const Motion& committed, bool leads_on,
                      const std::vector<Vector2>& trail = kTrail,
                      const MotionLimits& limits = rover().limits) {
  PlanQuery query;
  query.committed = committed;
  query.start_time_s = 4.0;
  PlannerInterface planner;
  planner.leads_on = [&](const PlanQuery&, const Motion&) { return leads_on; };
  PlanResult result;
  result.reason = reason;
  result.message = "no path";
  back_out_instead(query, trail, 1.0, limits, planner, result);
  return result;
}

const Motion kRest = standing(0.0, {0.0, 0.0}, 0.0);

TEST(BackOutInstead, BacksOutFromRestWhereThereIsNoWay) {
  for (const auto reason :
       {PlanReason::kNoPath, PlanReason::kNotCertified, PlanReason::kBudgetExhausted}) {
    const PlanResult result = instead_of(reason, kRest, true);
    EXPECT_EQ(result.reason, PlanReason::kBackingOut);
    EXPECT_EQ(result.motion.start_time(), 4.0);
    EXPECT_NEAR(result.motion.end_pose().position.x(), -1.0, 1e-6);
    EXPECT_EQ(std::get<DrivePhase>(result.motion.phases()[0]).direction, -1);
    EXPECT_EQ(result.message.find("no path"), 0u);
  }
}

TEST(BackOutInstead, AFailureStaysOneWhereBackingOutHelpsNothing) {
  for (const auto reason : {PlanReason::kPeerConflict, PlanReason::kGoalOccupied,
                            PlanReason::kStartOccupied, PlanReason::kInvalidInput}) {
    const PlanResult result = instead_of(reason, kRest, true);
    EXPECT_EQ(result.reason, reason);
    EXPECT_TRUE(result.motion.empty());
  }
}

TEST(BackOutInstead, AFailureStaysOneWhereTheRobotMovesOrCannotBackOut) {
  EXPECT_EQ(instead_of(PlanReason::kNoPath, long_drive(0.0, 20.0), true).reason,
            PlanReason::kNoPath);
  EXPECT_EQ(instead_of(PlanReason::kNoPath, kRest, false).reason, PlanReason::kNoPath);
  EXPECT_EQ(instead_of(PlanReason::kNoPath, kRest, true, {}).reason, PlanReason::kNoPath)
      << "it does not know where it came from";
  MotionLimits forward = rover().limits;
  forward.can_reverse = false;
  EXPECT_EQ(instead_of(PlanReason::kNoPath, kRest, true, kTrail, forward).reason,
            PlanReason::kNoPath)
      << "it cannot drive backward";
}

}  // namespace
}  // namespace mocha
