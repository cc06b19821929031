// The stops that are announced, of planning/replanner/replanner_stops.cpp.
#include "planning/replanner/replanner_test.h"
#include "safety/certificate.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

using ReplannerStopsTest = ReplannerTest;

TEST_F(ReplannerStopsTest, FirstPromisesToStandWhereItStands) {
  const RobotState here{kNow_s, {{1.0, 0.5}, 0.7}, {0.0, 0.0}};
  const auto output = replanner_.step(kNow_s, here, scene_);
  ASSERT_TRUE(output.proposal);
  EXPECT_EQ(output.row, Row::kStand) << to_text(output.row);
  EXPECT_TRUE(output.proposal->emergency);  // which is no question to the others
  EXPECT_FALSE(output.renew_lease);         // nothing is in force yet
  EXPECT_EQ(output.proposal->motion.length_m(), 0.0);
  EXPECT_EQ(output.proposal->motion.end_pose().position, here.pose.position);
  const auto waits = replanner_.step(kNow_s + 0.1, here, scene_);
  EXPECT_FALSE(waits.proposal);
  EXPECT_EQ(waits.row, Row::kWait);
  EXPECT_TRUE(replanner_.step(kNow_s + options_.answer_timeout_s + 0.01, here, scene_).proposal);
}

TEST_F(ReplannerStopsTest, FoundMovingItBrakesAtOnce) {
  const RobotState moving{kNow_s, {{1.0, 0.5}, 0.0}, {0.8, 0.1}};
  const auto output = replanner_.step(kNow_s, moving, scene_);
  ASSERT_TRUE(output.proposal);
  EXPECT_EQ(output.row, Row::kStopHere) << to_text(output.row);
  EXPECT_TRUE(output.proposal->emergency);
  EXPECT_EQ(output.reason, PlanReason::kBraking);
  EXPECT_NEAR(output.proposal->motion.at(kNow_s).speed, 0.8, 1e-6);
}

TEST_F(ReplannerStopsTest, OffItsTrackItBrakesFromWhereItIs) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  RobotState off = state(ahead_, now_s);
  off.pose.position.y() += options_.max_standing_error_m + 0.01;
  const auto output = replanner_.step(now_s, off, scene_);
  EXPECT_FALSE(output.renew_lease);
  EXPECT_TRUE(output.request_plan);
  ASSERT_TRUE(output.proposal);
  EXPECT_EQ(output.row, Row::kStopHere) << to_text(output.row);
  EXPECT_TRUE(output.proposal->emergency);
  const MotionState begin = output.proposal->motion.at(now_s);
  EXPECT_LT((begin.pose.position - off.pose.position).norm(), 1e-5);
  EXPECT_NEAR(begin.speed, 0.9, 0.02);
  EXPECT_NE(output.message.find(" m off "), std::string::npos) << output.message;
  RobotState turned = state(ahead_, now_s + 0.1);
  turned.pose.yaw_rad += options_.max_error_rad + 0.01;
  replanner_.on_refusal(output.proposal->sequence);
  EXPECT_TRUE(replanner_.step(now_s + 0.1, turned, scene_).proposal);
}

TEST_F(ReplannerStopsTest, AnOldMeasurementOfAFastRobotIsNotOffTrack) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  const RobotState old = state(ahead_, now_s - 0.15);  // 13 cm behind by now
  EXPECT_TRUE(replanner_.step(now_s, old, scene_).renew_lease);
}

TEST_F(ReplannerStopsTest, StoppedForAnEmergencyItPromisesWhatItDoes) {
  replanner_.set_committed(1, ahead_);
  replanner_.set_plan(ahead_);
  const double now_s = kNow_s + 4.0;
  const auto output = replanner_.halt(now_s, state(ahead_, now_s));
  EXPECT_EQ(output.reason, PlanReason::kEmergencyStop);
  EXPECT_FALSE(output.renew_lease);
  EXPECT_FALSE(output.request_plan);
  ASSERT_TRUE(output.proposal);
  EXPECT_EQ(output.row, Row::kEmergencyStop) << to_text(output.row);
  EXPECT_TRUE(output.proposal->emergency);
  const Motion& stop = output.proposal->motion;
  EXPECT_NEAR(stop.at(now_s).speed, 0.9, 1e-3);
  EXPECT_LT((stop.at(now_s).pose.position - ahead_.at(now_s).pose.position).norm(), 1e-3);
  const double brakes_m = 0.9 * 0.9 / (2.0 * robot_.max_wheel_acceleration);
  EXPECT_NEAR(stop.length_m(), brakes_m + 0.1 * 0.9, 0.02);
  EXPECT_FALSE(replanner_.halt(now_s + 0.1, state(stop, now_s + 0.1)).proposal);  // said already
  replanner_.set_committed(output.proposal->sequence, stop);
  for (double t = now_s + 0.1; t < now_s + 9.0; t += 0.1) {
    replanner_.set_plan(ahead_);  // is dropped
    EXPECT_FALSE(replanner_.halt(t, state(stop, t)).proposal) << t - now_s;
  }
  const auto after = step_on_track(now_s + 9.1);
  EXPECT_FALSE(after.proposal) << "sets off by itself after the reset";
  EXPECT_TRUE(replanner_.plan().empty());
}

TEST_F(ReplannerStopsTest, StoppedForAnEmergencyAndPushedItSaysWhereItIs) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  const RobotState here{kNow_s, {{0.01, -0.02}, 0.05}, {0.0, 0.0}};
  EXPECT_FALSE(replanner_.halt(kNow_s, here).proposal);
  const RobotState pushed{kNow_s + 1.0, {{0.3, -0.02}, 0.05}, {0.0, 0.0}};
  const auto output = replanner_.halt(kNow_s + 1.0, pushed);
  ASSERT_TRUE(output.proposal);
  EXPECT_EQ(output.row, Row::kEmergencyStop) << to_text(output.row);
  EXPECT_LT((output.proposal->motion.end_pose().position - Vector2(0.3, -0.02)).norm(), 1e-4);
  EXPECT_EQ(output.proposal->motion.length_m(), 0.0);
  EXPECT_TRUE(LocalReplanner(robot_, options_, default_local_options()).halt(kNow_s, here).proposal)
      << "nothing was promised yet";
}

/// Without data nothing can be certified: what is in force is left by braking along it.
TEST_F(ReplannerStopsTest, WithoutDataItSaysAtOnceThatItBrakes) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  const auto output = replanner_.stop_blind(now_s);
  EXPECT_EQ(output.row, Row::kStopBlind);
  EXPECT_FALSE(output.renew_lease);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);
  const Motion& stop = output.proposal->motion;
  EXPECT_NEAR(stop.start_time(), now_s + options_.emergency_s, 1e-6);
  const auto driven = splice(ahead_, now_s, stop.start_time(), stop);
  ASSERT_TRUE(driven) << describe(driven.fault);
  // Along what was promised, and not beyond.
  for (double t = stop.start_time(); t < stop.end_time(); t += 0.05) {
    EXPECT_NEAR(stop.position(t).y(), 0.0, 1e-3);
    EXPECT_LE(stop.position(t).x(), ahead_.position(t).x() + 1e-3);
  }
  const double brakes_m = 0.9 * 0.9 / (2.0 * robot_.braking().deceleration());
  EXPECT_NEAR(stop.length_m(), brakes_m, 0.15 * 0.9);
  EXPECT_FALSE(check_limits(stop, robot_.limits, now_s));
}

TEST_F(ReplannerStopsTest, WithoutDataItSaysSoOnce) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  const auto first = replanner_.stop_blind(now_s);
  ASSERT_TRUE(first.proposal);
  EXPECT_FALSE(replanner_.stop_blind(now_s + 0.1).proposal);
  replanner_.set_committed(first.proposal->sequence, first.proposal->motion);
  for (int i = 2; i < 60; ++i) {
    const auto later = replanner_.stop_blind(now_s + 0.1 * i);
    EXPECT_FALSE(later.proposal) << i;
    EXPECT_EQ(later.row, Row::kStopBlind);
    EXPECT_FALSE(later.renew_lease);
  }
  EXPECT_EQ(replanner_.count(Row::kStopBlind), 60);
}

TEST_F(ReplannerStopsTest, WithoutDataAProposalWithoutAnswerIsMadeAgain) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  ASSERT_TRUE(replanner_.stop_blind(now_s).proposal);
  EXPECT_TRUE(replanner_.stop_blind(now_s + options_.answer_timeout_s + 0.01).proposal);
}

TEST_F(ReplannerStopsTest, WithoutDataItDoesNotWaitForTheAnswerToAPlan) {
  replanner_.set_committed(1, ahead_);
  replanner_.set_plan(ahead_);
  const double now_s = kNow_s + 2.0;
  ASSERT_TRUE(step_on_track(now_s).proposal);
  EXPECT_TRUE(replanner_.stop_blind(now_s + 0.1).proposal);
}

TEST_F(ReplannerStopsTest, WithoutDataThereIsNothingToSayAtRest) {
  EXPECT_FALSE(replanner_.stop_blind(kNow_s).proposal) << "nothing was promised";
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  EXPECT_FALSE(replanner_.stop_blind(kNow_s).proposal);
  replanner_.set_committed(2, ahead_);
  EXPECT_FALSE(replanner_.stop_blind(ahead_.end_time() + 1.0).proposal);
}

TEST_F(ReplannerStopsTest, WithoutDataThereIsNothingToSayWhereItStopsAsSoonAnyway) {
  replanner_.set_committed(1, ahead_);
  EXPECT_FALSE(replanner_.stop_blind(ahead_.end_time() - 0.3).proposal);
  EXPECT_TRUE(replanner_.stop_blind(ahead_.end_time() - 4.0).proposal);
}

/// What begins only after the turn that is under way is not driven.
TEST_F(ReplannerStopsTest, WithoutDataATurnInPlaceIsEnded) {
  const TurnPhase turn{{{0.0, 0.0}, -1.5}, 1.5, 3.0};
  const Motion turns(kNow_s, {turn, ahead_.phases().front()});
  replanner_.set_committed(1, turns);
  const auto output = replanner_.stop_blind(kNow_s + 1.0);
  ASSERT_TRUE(output.proposal);
  const Motion& stop = output.proposal->motion;
  EXPECT_LT(stop.start_time(), kNow_s + 1.2);
  EXPECT_LT(stop.end_time(), kNow_s + 2.0);
  EXPECT_EQ(stop.length_m(), 0.0);
  EXPECT_NEAR(stop.at(stop.start_time()).pose.yaw_rad, turns.at(stop.start_time()).pose.yaw_rad,
              1e-4);
}

TEST_F(ReplannerStopsTest, WithDataAgainItGoesOn) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
  EXPECT_FALSE(replanner_.stop_blind(kNow_s).proposal);
  const auto output = step_on_track(kNow_s + 0.1);
  EXPECT_EQ(output.row, Row::kFollow);
  EXPECT_TRUE(output.proposal);
}

}  // namespace
}  // namespace mocha
