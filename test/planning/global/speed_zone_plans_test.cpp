#include "planning/global/global_planner_fixture.h"

namespace mocha {
namespace {

constexpr double kSlow_mps = 0.3;

struct SpeedZonePlansTest : GlobalPlannerTest {
  PlanResult plan_with(const PlanQuery& query, const Zones& zones, double since_s) const {
    slow_ = SpeedZones::of(zones, robot_, since_s);
    return planner_.plan(query, {static_map_of(open_), {}, {}, slow_});
  }
  void expect_kept(const PlanResult& result) const {
    ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
    const Violation violation =
        check_speed_zones(result.motion, *slow_, result.motion.start_time());
    EXPECT_FALSE(violation) << describe(violation);
  }
  static double fastest_beyond(const PlanResult& result, double from_x, double to_x) {
    double fastest = 0.0;
    for (double t = result.motion.start_time(); t < result.motion.end_time(); t += 0.01) {
      const MotionState state = result.motion.at(t);
      if (state.pose.position.x() > from_x && state.pose.position.x() < to_x)
        fastest = std::max(fastest, state.speed);
    }
    return fastest;
  }

  mutable std::shared_ptr<const SpeedZones> slow_;
  const Zone across_{"across", Polygon{{{4.0, -9.0}, {6.0, -9.0}, {6.0, 9.0}, {4.0, 9.0}}},
                     kSlow_mps};
};

TEST_F(SpeedZonePlansTest, AreSlowInTheZoneAndFastElsewhere) {
  const PlanQuery query = from_standing({0.0, 0.0}, 0.0, {10.0, 0.0});
  const PlanResult result = plan_with(query, {across_}, 0.0);
  expect_kept(result);
  expect_certified(result, query, open_);
  EXPECT_GT(fastest_beyond(result, 4.2, 5.8), 0.7 * kSlow_mps);
  EXPECT_GT(fastest_beyond(result, 0.0, 3.5), 0.6 * robot_.limits.max_speed);
  EXPECT_GT(fastest_beyond(result, 6.5, 10.0), 0.6 * robot_.limits.max_speed);
}

TEST_F(SpeedZonePlansTest, SlowDownInAZoneThatHasJustComeIntoForce) {
  const Motion drive = straight_drive(kStart_s - 3.0, {0.0, 0.0}, 0.0, 11.0, 0.8, 0.4);
  PlanQuery query;
  query.committed = drive;
  query.start_time_s = drive.switch_time(kStart_s);
  query.goal = {11.0, 0.0};
  Zone everywhere = across_;
  everywhere.area = Polygon{{{-9.0, -9.0}, {20.0, -9.0}, {20.0, 9.0}, {-9.0, 9.0}}};
  const PlanResult result = plan_with(query, {everywhere}, kStart_s - 1.0);
  expect_kept(result);
  expect_joined(result, query);
  EXPECT_GT(drive.at(query.start_time_s).speed, 2.0 * kSlow_mps);
}

TEST_F(SpeedZonePlansTest, StartInsideAndEndInside) {
  expect_kept(plan_with(from_standing({5.0, 0.0}, 0.0, {10.0, 1.0}), {across_}, 0.0));
  expect_kept(plan_with(from_standing({0.0, 0.0}, 2.0, {5.0, 1.0}), {across_}, 0.0));
  const Zone creep{"creep", across_.area, 0.1};
  expect_kept(plan_with(from_standing({0.0, 0.0}, 0.0, {10.0, 0.0}), {creep}, 0.0));
}

TEST_F(SpeedZonePlansTest, ZonesBesideTheWayCostNothing) {
  const PlanQuery query = from_standing({0.0, 0.0}, 0.0, {10.0, 0.0});
  const Zone beside{"beside", Polygon{{{4.0, 1.5}, {6.0, 1.5}, {6.0, 3.0}, {4.0, 3.0}}}, 0.1};
  const PlanResult with = plan_with(query, {beside}, 0.0);
  const PlanResult without = plan(query, open_);
  expect_kept(with);
  EXPECT_LT(with.motion.end_time(), without.motion.end_time() + 0.05);
}

}  // namespace
}  // namespace mocha
