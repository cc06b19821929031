#include "stack/delay_cause.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

GoalExecutive::Report said(PlanReason reason, const std::string& message) {
  GoalExecutive::Report report;
  report.reason = reason;
  report.message = message;
  return report;
}

class DelayCauseTest : public ::testing::Test {
 protected:
  DelayCauseTest() { cause_.hear_planner(said(PlanReason::kNoPath, "no path")); }

  DelayCause cause_;
  GoalExecutive::Report clearance_ = said(PlanReason::kNotCertified, "clearance 0.069 m");
};

TEST_F(DelayCauseTest, WithoutAPlanThePlannerKnows) {
  cause_.hear_replanner(clearance_, kNow_s);
  EXPECT_EQ(cause_.cause(false, kNow_s).message, "no path");
}

TEST_F(DelayCauseTest, SaysThatAPlanCameTooLate) {
  cause_.hear_replanner(said(PlanReason::kNotCertified, "does not join"), kNow_s);
  cause_.hear_planning_time(0.9, 0.5);
  EXPECT_EQ(cause_.cause(true, kNow_s).message,
            "local replanner: does not join; planning took 0.9 s, planning_time is 0.5 s");
  cause_.hear_planning_time(0.3, 0.5);
  EXPECT_EQ(cause_.cause(true, kNow_s).message, "local replanner: does not join");
}

TEST_F(DelayCauseTest, WithAPlanTheLocalReplannerKnows) {
  cause_.hear_planner(said(PlanReason::kSolved, "solved"));
  EXPECT_EQ(cause_.cause(true, kNow_s).reason, PlanReason::kSolved);
  clearance_.violation.term = ViolatedTerm::kClearance;
  cause_.hear_replanner(clearance_, kNow_s);
  const auto cause = cause_.cause(true, kNow_s + 60.0);  // it says so where that changes
  EXPECT_EQ(cause.reason, PlanReason::kNotCertified);
  EXPECT_EQ(cause.message, "local replanner: clearance 0.069 m");
  EXPECT_EQ(cause.violation.term, ViolatedTerm::kClearance);
}

TEST_F(DelayCauseTest, BetweenTwoAttemptsItHoldsStill) {
  cause_.hear_planner(said(PlanReason::kSolved, "solved"));
  cause_.hear_replanner(clearance_, kNow_s);
  cause_.hear_replanner(said(PlanReason::kSolved, ""), kNow_s + 0.1);
  cause_.hear_replanner(said(PlanReason::kNoGoal, "stops"), kNow_s + 0.2);
  EXPECT_EQ(cause_.cause(true, kNow_s + 1.0).reason, PlanReason::kNotCertified);
  EXPECT_EQ(cause_.cause(true, kNow_s + 3.0).reason, PlanReason::kSolved);
}

}  // namespace
}  // namespace mocha
