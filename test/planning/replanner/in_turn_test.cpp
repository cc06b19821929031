// A robot on a stretch of an order of passing: others count on where it is.
#include "planning/local/rejoining.h"
#include "planning/replanner/replanner_test.h"
#include "trajectory/rover_braking.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

class InTurnTest : public ReplannerTest {
 protected:
  InTurnTest() { replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0)); }

  void add_peer(Motion motion) {
    scene_.peers = {std::make_shared<PeerObstacle>(
        "ugv2", std::make_shared<const Motion>(std::move(motion)), 0.3, test::kRoverBraking)};
  }

  /// A team-mate that crosses at x = 2 m, from `y` on.
  void cross_from(double y) {
    add_peer(straight_drive(kNow_s, {2.0, y}, -M_PI / 2.0, y + 2.5, 0.9, 0.5));
  }

  double least_gap_m(const Motion& motion) const {
    double least_m = 1e9;
    for (double t = kNow_s; t < motion.end_time() + 5.0; t += 0.05) {
      const Vector2 apart = motion.position(t) - scene_.peers[0]->at(t).centre;
      least_m = std::min(least_m, apart.norm());
    }
    return least_m;
  }
};

TEST_F(InTurnTest, WaitsForItsWayToGetFreeAndPromisesTheWholeOfIt) {
  cross_from(2.0);
  replanner_.set_plan(plan_from(kNow_s + options_.settle_s), PlanKind::kInTurn);
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal) << output.message;
  EXPECT_EQ(output.row, Row::kFollow) << to_text(output.row);
  EXPECT_FALSE(output.request_plan);
  const Motion& motion = output.proposal->motion;
  EXPECT_GT(motion.end_pose().position.x(), 2.0);
  EXPECT_GT(least_gap_m(motion), 0.9);
  EXPECT_NEAR(motion.end_pose().position.y(), 0.0, 0.02);
}

TEST_F(InTurnTest, StaysOnItsLineBehindWhoStandsThere) {
  add_peer(standing(kNow_s - 9.0, {3.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + options_.settle_s), PlanKind::kInTurn);
  for (double t = kNow_s; t < kNow_s + 12.0; t += 0.1) {
    const auto output = step_on_track(t);
    EXPECT_TRUE(output.row == Row::kFollow || output.row == Row::kKeep || output.row == Row::kWait)
        << to_text(output.row);
    EXPECT_FALSE(output.swerves);
    EXPECT_TRUE(output.renew_lease);
    if (!output.proposal) continue;
    EXPECT_NEAR(output.proposal->motion.end_pose().position.y(), 0.0, 0.02);
    EXPECT_LT(output.proposal->motion.end_pose().position.x(), 3.0 - 0.9);
    replanner_.set_committed(output.proposal->sequence, output.proposal->motion);
  }
}

TEST_F(InTurnTest, PromisesTheWholeAtOnce) {
  const Motion plan = plan_from(kNow_s + options_.settle_s);
  replanner_.set_plan(plan, PlanKind::kInTurn);
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal);
  ASSERT_GT(plan.end_time(), kNow_s + options_.horizon_s + 3.0);
  EXPECT_NEAR(output.proposal->motion.end_time(), plan.end_time(), 0.01);
  replanner_.set_committed(output.proposal->sequence, output.proposal->motion);
  for (double t = kNow_s + 0.1; t < kNow_s + 6.0; t += 0.1)
    EXPECT_FALSE(step_on_track(t).proposal) << t;
}

TEST_F(InTurnTest, TakesNothingBackThatItHasPromised) {
  const Motion quick = plan_from(kNow_s - 1.0);
  replanner_.set_committed(1, quick);
  // One that brakes first, and meets who crosses behind the quick one.
  const double join_s = kNow_s + options_.settle_s;
  std::vector<Phase> phases = brake_along(quick, join_s, Braking(0.5));
  const Pose stop = Motion(join_s, phases).end_pose();
  phases.emplace_back(StandPhase{stop, 2.0});
  const Motion on = straight_drive(0.0, stop.position, 0.0, 8.0 - stop.position.x(), 0.9, 0.5);
  phases.insert(phases.end(), on.phases().begin(), on.phases().end());
  const Motion slow(join_s, phases);
  const double meets_s = *progress_on(slow, {4.0, 0.0}, join_s, 0.1);
  ASSERT_GT(meets_s, *progress_on(quick, {4.0, 0.0}, kNow_s, 0.1) + 2.0);
  add_peer(straight_drive(meets_s - 3.5, {4.0, 2.5}, -M_PI / 2.0, 5.0, 0.9, 0.5));
  replanner_.set_plan(slow, PlanKind::kInTurn);
  const auto output = step_on_track(kNow_s);
  EXPECT_FALSE(output.proposal);
  EXPECT_TRUE(output.renew_lease);
  EXPECT_TRUE(output.request_plan) << "there may be a better one";
}

TEST_F(InTurnTest, AnOfferIsTakenThoughTheOneAtHandMeetsNobody) {
  cross_from(2.5);
  replanner_.set_plan(plan_from(kNow_s + options_.settle_s), PlanKind::kFree);
  ASSERT_TRUE(step_on_track(kNow_s).proposal);
  replanner_.set_plan(plan_from(kNow_s + options_.settle_s), PlanKind::kInTurn);
  EXPECT_FALSE(step_on_track(kNow_s + 0.1).keeps_plan);
}

TEST_F(InTurnTest, StillBrakesForWhatMovesIntoItsWay) {
  replanner_.set_plan(plan_from(kNow_s + options_.settle_s), PlanKind::kInTurn);
  auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal);
  replanner_.set_committed(output.proposal->sequence, output.proposal->motion);
  const double now_s = kNow_s + 2.0;
  scene_.confident = {std::make_shared<PredictedDisc>("person", now_s, Vector2(3.0, 0.9),
                                                      Vector2(0.0, -0.4), 0.25, 0.0)};
  scene_.predicted_until_s = now_s + 5.0;
  output = step_on_track(now_s);
  ASSERT_TRUE(output.proposal);
  EXPECT_FALSE(output.renew_lease);
  EXPECT_NE(output.row, Row::kFollow);
}

}  // namespace
}  // namespace mocha
