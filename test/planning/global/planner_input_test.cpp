#include <cmath>
#include <limits>

#include "planning/global/global_planner_fixture.h"

namespace mocha {
namespace {

using PlannerInput = GlobalPlannerTest;

TEST_F(PlannerInput, InvalidInputIsNamedAndNothingMoves) {
  const PlanQuery good = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
  const auto expect_reason = [&](const PlanQuery& query, PlanReason reason) {
    const PlanResult result = plan(query, open_);
    EXPECT_EQ(result.reason, reason) << result.message;
    EXPECT_TRUE(result.motion.empty());
    EXPECT_FALSE(result.message.empty());
  };
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    PlanQuery query = good;
    query.goal.y() = bad;
    expect_reason(query, PlanReason::kInvalidInput);
    query = good;
    query.goal_yaw_rad = bad;
    expect_reason(query, PlanReason::kInvalidInput);
    query = good;
    query.start_time_s = bad;
    expect_reason(query, PlanReason::kInvalidInput);
  }
  PlanQuery query = good;
  query.committed = Motion();
  expect_reason(query, PlanReason::kNoPose);
  EXPECT_EQ(planner_.plan(good, {}).reason, PlanReason::kNoMap);
}

TEST_F(PlannerInput, HugeNumbersAreNoWay) {
  for (const double huge : {1e6, 1e9, 1e300, -1e300}) {
    PlanQuery query = from_standing({0.0, 0.0}, 0.0, {huge, 0.0});
    EXPECT_EQ(plan(query, open_).reason, PlanReason::kNoPath) << huge;
    query = from_standing({huge, 0.0}, 0.0, {8.0, 0.0});
    EXPECT_TRUE(plan(query, open_).motion.empty()) << huge;
    query = from_standing({0.0, 0.0}, 0.0, {8.0, 0.0});
    query.goal_yaw_rad = huge;
    plan(query, open_);
  }
}

TEST_F(PlannerInput, AMapFarFromItsOriginIsNone) {
  for (const double far_m : {2e6, -2e6, 1e12}) {
    const OccupancyGrid far = free_grid({far_m - 6.0, -4.0}, {far_m + 8.0, 4.0});
    const PlanQuery query = from_standing({far_m - 3.0, 0.0}, 0.0, {far_m + 3.0, 0.0});
    PlanResult result;
    ASSERT_NO_THROW(result = plan(query, far)) << far_m;
    EXPECT_EQ(result.reason, PlanReason::kNoMap) << far_m << ": " << result.message;
    EXPECT_TRUE(result.motion.empty());
    EXPECT_FALSE(result.message.empty());
  }
}

TEST_F(PlannerInput, FromAStateThatNoRobotHasThereIsAReasonAndNoPlan) {
  for (const double speed : {30.0, 1e3, 1e5, 1e6}) {
    PlanQuery query;
    query.committed = straight_drive(kStart_s, {-2.0 * speed, 0.0}, 0.0, 4.0 * speed, speed, speed);
    query.start_time_s = 0.5 * (kStart_s + query.committed.end_time());
    query.goal = {8.0, 0.0};
    PlanResult result;
    ASSERT_NO_THROW(result = plan(query, open_)) << speed;
    EXPECT_EQ(result.reason, PlanReason::kNotCertified) << speed << ": " << result.message;
    EXPECT_TRUE(result.motion.empty());
    EXPECT_EQ(result.message.find("no violation"), std::string::npos) << result.message;
  }
}

TEST_F(PlannerInput, AMapOfOneCellIsNoWay) {
  const OccupancyGrid tiny = free_grid({0.0, 0.0}, {0.05, 0.05});
  EXPECT_EQ(plan(from_standing({0.02, 0.02}, 0.0, {8.0, 0.0}), tiny).reason, PlanReason::kNoPath);
}

}  // namespace
}  // namespace mocha
