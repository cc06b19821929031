// What becomes of a promise where there is nothing to drive to any more.
#include "planning/replanner/replanner_test.h"
#include "trajectory/rover_braking.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

class NoGoalTest : public ReplannerTest {
 protected:
  /// Under way at full speed, on the plan.
  static constexpr double kDriving_s = kNow_s + 4.0;

  NoGoalTest() {
    replanner_.set_plan(ahead_);
    replanner_.set_committed(1, ahead_);
  }

  /// Stands, with a plan that is proposed and not answered yet.
  void be_about_to_set_off(const Motion& plan) {
    replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
    replanner_.set_plan(plan);
    ASSERT_TRUE(step_on_track(kNow_s).proposal);
  }

  void expect_stand(const LocalReplanner::Output& output) const {
    EXPECT_EQ(output.row, Row::kStop) << to_text(output.row);
    ASSERT_TRUE(output.proposal);
    EXPECT_TRUE(output.proposal->emergency);
    EXPECT_LT(output.proposal->motion.length_m(), 1e-3);
  }
};

TEST_F(NoGoalTest, ItBrakesAlongItsPromiseAtOnceAndSaysWhy) {
  replanner_.set_plan(Motion());
  const auto output = step_on_track(kDriving_s);
  EXPECT_EQ(output.row, Row::kStop) << to_text(output.row);
  EXPECT_EQ(output.reason, PlanReason::kNoGoal);
  EXPECT_EQ(output.message, "stops: no goal");
  EXPECT_FALSE(output.request_plan);
  EXPECT_TRUE(output.renew_lease);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);
  const Motion& stop = output.proposal->motion;
  EXPECT_NEAR(stop.start_time(), kDriving_s + options_.emergency_s, 1e-6);
  ASSERT_TRUE(splice(ahead_, kDriving_s, stop.start_time(), stop));
  for (double t = stop.start_time(); t < stop.end_time(); t += 0.05) {
    EXPECT_NEAR(stop.position(t).y(), 0.0, 1e-3);
    EXPECT_LE(stop.position(t).x(), ahead_.position(t).x() + 1e-3);
  }
  const double brakes_m = 0.9 * 0.9 / (2.0 * robot_.braking().deceleration());
  EXPECT_NEAR(stop.length_m(), brakes_m, 0.15 * 0.9);
  EXPECT_FALSE(check_limits(stop, robot_.limits, kDriving_s));
}

TEST_F(NoGoalTest, ItSaysSoOnceAndRests) {
  replanner_.set_plan(Motion());
  const auto stop = step_on_track(kDriving_s).proposal;
  ASSERT_TRUE(stop);
  EXPECT_FALSE(step_on_track(kDriving_s + 0.1).proposal) << "waits for the answer";
  replanner_.set_committed(stop->sequence, stop->motion);
  for (int i = 2; i < 60; ++i) {
    const auto later = step_on_track(kDriving_s + 0.1 * i);
    EXPECT_FALSE(later.proposal) << i;
    EXPECT_EQ(later.row, Row::kKeep) << to_text(later.row);
    EXPECT_TRUE(later.renew_lease);
  }
}

TEST_F(NoGoalTest, AProposalToSetOffIsReplacedByOneToStand) {
  be_about_to_set_off(plan_from(kNow_s + 0.5));
  replanner_.set_plan(Motion());
  expect_stand(step_on_track(kNow_s + 0.1));
  EXPECT_FALSE(step_on_track(kNow_s + 0.2).proposal);
}

TEST_F(NoGoalTest, AMotionThatBeginsInAMomentDoesNotBegin) {
  replanner_.set_plan(Motion());
  replanner_.set_committed(2, plan_from(kNow_s + 0.05));
  expect_stand(step_on_track(kNow_s));
  replanner_.set_committed(3, plan_from(kNow_s + 0.45));
  expect_stand(step_on_track(kNow_s + 0.15));
}

TEST_F(NoGoalTest, ATurnInPlaceThatBeginsInAMomentDoesNotBegin) {
  const TurnPhase turn{{{0.0, 0.0}, -1.5}, 1.5, 3.0};
  replanner_.set_committed(2, Motion(kNow_s + 0.05, {turn, ahead_.phases().front()}));
  replanner_.set_plan(Motion());
  const auto output = step_on_track(kNow_s);
  expect_stand(output);
  EXPECT_NEAR(output.proposal->motion.end_pose().yaw_rad, -1.5, 1e-4);
}

TEST_F(NoGoalTest, ItBrakesAtOnceBesideAPeer) {
  const auto stand = std::make_shared<const Motion>(standing(kNow_s - 9.0, {4.0, 1.5}, 0.0));
  scene_.peers = {std::make_shared<PeerObstacle>("ugv2", stand, 0.3, test::kRoverBraking)};
  replanner_.set_plan(Motion());
  const auto output = step_on_track(kDriving_s);
  EXPECT_EQ(output.row, Row::kStop) << to_text(output.row);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);
}

TEST_F(NoGoalTest, ItDoesNotWaitForAnAnswerToLaterBraking) {
  block(7.0);
  const auto late = step_on_track(kDriving_s - 1.0);
  ASSERT_EQ(late.row, Row::kBrakeInTime) << to_text(late.row);
  replanner_.set_plan(Motion());
  const auto output = step_on_track(kDriving_s - 0.9);
  EXPECT_EQ(output.row, Row::kStop) << to_text(output.row);
  ASSERT_TRUE(output.proposal);
  EXPECT_LT(output.proposal->motion.end_time(), late.proposal->motion.end_time());
}

/// Somebody will pass behind it: to stop there would be in the way.
TEST_F(NoGoalTest, ItGoesOnWhereToStopIsNotCertified) {
  const double x = ahead_.position(kDriving_s).x() + 1.0;
  scene_.likely = {std::make_shared<PredictedDisc>("person", kDriving_s, Vector2(x, -2.7),
                                                   Vector2(0.0, 1.0), 0.25, 0.0)};
  scene_.predicted_until_s = kDriving_s + 5.0;
  const auto before = step_on_track(kDriving_s);
  ASSERT_TRUE(before.renew_lease) << describe(before.violation);
  replanner_.set_plan(Motion());
  const auto output = step_on_track(kDriving_s);
  EXPECT_NE(output.row, Row::kStop);
  EXPECT_TRUE(output.renew_lease);
  scene_.likely.clear();
  EXPECT_EQ(step_on_track(kDriving_s + 0.1).row, Row::kStop);
}

TEST_F(NoGoalTest, WithAPlanAgainItGoesOn) {
  replanner_.set_plan(Motion());
  const auto stop = step_on_track(kDriving_s).proposal;
  ASSERT_TRUE(stop);
  replanner_.set_committed(stop->sequence, stop->motion);
  const double rests_s = stop->motion.end_time() + 0.1;
  const double x = stop->motion.end_pose().position.x();
  replanner_.set_plan(straight_drive(rests_s + 0.5, {x, 0.0}, 0.0, 3.0, 0.9, 0.5));
  EXPECT_EQ(step_on_track(rests_s).row, Row::kFollow);
}

}  // namespace
}  // namespace mocha
