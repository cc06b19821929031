#include "planning/local_replanner.h"

#include <gtest/gtest.h>

#include "fleet/wire_format.h"
#include "planning/closed_loop.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class LocalReplannerTest : public ::testing::Test {
 protected:
  RobotState state(const Motion& motion, double now_s) const {
    const MotionState at = motion.at(now_s);
    return {now_s, at.pose, {at.speed, at.yaw_rate}};
  }

  LocalReplanner::Output step_on_track(double now_s) {
    return replanner_.step(now_s, state(replanner_.committed(), now_s), scene_);
  }

  void block(double from_x) {
    OccupancyGrid grid = open_;
    fill_box(grid, {from_x, -3.0}, {from_x + 0.5, 3.0});
    scene_ = {occupied_field(grid), unseen_field(grid), {}};
  }

  const RobotModel robot_ = rover();
  const LocalReplannerRules rules_ = default_replanner_rules(robot_);
  LocalReplanner replanner_{robot_, rules_, default_local_rules()};
  const OccupancyGrid open_ = free_grid({-2.0, -3.0}, {12.0, 3.0});
  PromiseScene scene_{occupied_field(open_), unseen_field(open_), {}};
  const Motion ahead_ = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
};

TEST_F(LocalReplannerTest, FirstPromisesToStandWhereItStands) {
  const RobotState here{kNow_s, {{1.0, 0.5}, 0.7}, {0.0, 0.0}};
  const auto output = replanner_.step(kNow_s, here, scene_);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);  // which is no question to the others
  EXPECT_FALSE(output.renew_lease);         // nothing is in force yet
  EXPECT_EQ(output.proposal->motion.length_m(), 0.0);
  EXPECT_EQ(output.proposal->motion.end_pose().position, here.pose.position);
  EXPECT_FALSE(replanner_.step(kNow_s + 0.1, here, scene_).proposal);  // waits for the answer
  EXPECT_TRUE(replanner_.step(kNow_s + rules_.answer_timeout_s + 0.01, here, scene_).proposal);
}

TEST_F(LocalReplannerTest, FoundMovingItBrakesAtOnce) {
  const RobotState moving{kNow_s, {{1.0, 0.5}, 0.0}, {0.8, 0.1}};
  const auto output = replanner_.step(kNow_s, moving, scene_);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);
  EXPECT_EQ(output.reason, PlanReason::kBraking);
  EXPECT_NEAR(output.proposal->motion.at(kNow_s).speed, 0.8, 1e-6);
}

TEST_F(LocalReplannerTest, RenewsTheLeaseWhileTheProofHolds) {
  replanner_.set_committed(1, ahead_);
  for (double t = kNow_s; t < ahead_.end_time() + 2.0; t += 0.1)
    EXPECT_TRUE(step_on_track(t).renew_lease);
}

TEST_F(LocalReplannerTest, BrakesForAnObstacleWithTimeToSettle) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 2.0;
  block(6.0);
  const auto output = step_on_track(now_s);
  EXPECT_FALSE(output.renew_lease);
  EXPECT_EQ(output.reason, PlanReason::kBraking);
  EXPECT_EQ(output.violation.term, ViolatedTerm::kClearance);
  EXPECT_TRUE(output.request_plan);
  ASSERT_TRUE(output.proposal);
  EXPECT_FALSE(output.proposal->emergency);
  EXPECT_GE(output.proposal->motion.start_time(), now_s + rules_.settle_s - 1e-6);
  EXPECT_LT(output.proposal->motion.end_pose().position.x(), 6.0 - 0.4);
}

TEST_F(LocalReplannerTest, BrakesAtOnceForAnObstacleThatIsClose) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  const double here_x = ahead_.at(now_s).pose.position.x();
  // Farther than the stopping distance after emergency_time, but not after settle_time.
  block(std::ceil((here_x + 0.3 + 0.1 + 0.9 * 0.1 + 0.9 * 0.9 / (2.0 * 0.48) + 0.15) * 20.0) /
        20.0);
  const auto output = step_on_track(now_s);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);
  EXPECT_NE(output.message.find("brakes in time"), std::string::npos) << output.message;
  EXPECT_FALSE(check_limits(output.proposal->motion, robot_.limits, now_s));
}

TEST_F(LocalReplannerTest, BrakesAllTheSameWhereNoStopIsSafe) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  block(ahead_.at(now_s).pose.position.x() + 0.6);
  const auto output = step_on_track(now_s);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);
  EXPECT_NE(output.message.find("NO CERTIFIED MOTION"), std::string::npos) << output.message;
  EXPECT_LT(output.proposal->motion.end_time(), now_s + 3.0);
}

TEST_F(LocalReplannerTest, AnEmergencyDoesNotWaitForAnAnswer) {
  replanner_.set_committed(1, ahead_);
  replanner_.set_plan(ahead_);
  const double now_s = kNow_s + 2.0;
  ASSERT_TRUE(step_on_track(now_s).proposal);  // asks for a promise and waits
  block(4.0);
  const auto brake = step_on_track(now_s + 0.1);
  ASSERT_TRUE(brake.proposal) << "waits with braking for the answer to an older proposal";
  EXPECT_EQ(brake.reason, PlanReason::kBraking);
  EXPECT_FALSE(step_on_track(now_s + 0.2).proposal);  // but says so only once
}

TEST_F(LocalReplannerTest, OffItsTrackItBrakesFromWhereItIs) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  RobotState off = state(ahead_, now_s);
  off.pose.position.y() += rules_.max_error_m + 0.01;
  const auto output = replanner_.step(now_s, off, scene_);
  EXPECT_FALSE(output.renew_lease);
  EXPECT_TRUE(output.request_plan);
  ASSERT_TRUE(output.proposal);
  EXPECT_TRUE(output.proposal->emergency);
  const MotionState begin = output.proposal->motion.at(now_s);
  EXPECT_LT((begin.pose.position - off.pose.position).norm(), 1e-5);
  EXPECT_NEAR(begin.speed, 0.9, 0.02);
  EXPECT_NE(output.message.find(" m off "), std::string::npos) << output.message;
  RobotState turned = state(ahead_, now_s + 0.1);
  turned.pose.yaw_rad += rules_.max_error_rad + 0.01;
  replanner_.on_refusal(output.proposal->sequence);
  EXPECT_TRUE(replanner_.step(now_s + 0.1, turned, scene_).proposal);
}

TEST_F(LocalReplannerTest, StoppedForAnEmergencyItPromisesWhatItDoes) {
  replanner_.set_committed(1, ahead_);
  replanner_.set_plan(ahead_);
  const double now_s = kNow_s + 4.0;
  const auto output = replanner_.halt(now_s, state(ahead_, now_s));
  EXPECT_EQ(output.reason, PlanReason::kEmergencyStop);
  EXPECT_FALSE(output.renew_lease);
  EXPECT_FALSE(output.request_plan);
  ASSERT_TRUE(output.proposal);
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

TEST_F(LocalReplannerTest, StoppedForAnEmergencyAndPushedItSaysWhereItIs) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  const RobotState here{kNow_s, {{0.01, -0.02}, 0.05}, {0.0, 0.0}};
  EXPECT_FALSE(replanner_.halt(kNow_s, here).proposal);
  const RobotState pushed{kNow_s + 1.0, {{0.3, -0.02}, 0.05}, {0.0, 0.0}};
  const auto output = replanner_.halt(kNow_s + 1.0, pushed);
  ASSERT_TRUE(output.proposal);
  EXPECT_LT((output.proposal->motion.end_pose().position - Vector2(0.3, -0.02)).norm(), 1e-4);
  EXPECT_EQ(output.proposal->motion.length_m(), 0.0);
  EXPECT_TRUE(LocalReplanner(robot_, rules_, default_local_rules()).halt(kNow_s, here).proposal)
      << "nothing was promised yet";
}

TEST_F(LocalReplannerTest, AnOldMeasurementOfAFastRobotIsNotOffTrack) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  const RobotState old = state(ahead_, now_s - 0.15);  // 13 cm behind by now
  EXPECT_TRUE(replanner_.step(now_s, old, scene_).renew_lease);
}

TEST_F(LocalReplannerTest, ProposesAPlanThatJoins) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal) << output.message;
  EXPECT_FALSE(output.proposal->emergency);
  EXPECT_NEAR(output.proposal->motion.start_time(), kNow_s + 0.5, 1e-6);
  EXPECT_GT(output.proposal->motion.end_pose().position.x(), 1.5);  // the horizon
  EXPECT_LT(output.proposal->motion.end_pose().position.x(), 7.0);
  EXPECT_FALSE(output.request_plan);
}

TEST_F(LocalReplannerTest, ProposesWhatTheOthersWillHold) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal);
  const Motion& motion = output.proposal->motion;
  const Motion heard = quantised(motion);
  for (double t = motion.start_time(); t < motion.end_time(); t += 0.1)
    EXPECT_EQ(heard.position(t), motion.position(t));
}

TEST_F(LocalReplannerTest, APlanThatIsNearIsComeBackTo) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.2}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  const auto near_by = step_on_track(kNow_s);
  ASSERT_TRUE(near_by.proposal) << near_by.message;
  EXPECT_FALSE(near_by.request_plan);
  const Motion& plan = replanner_.plan();
  EXPECT_EQ(plan.at(plan.start_time()).pose.position, Vector2(0.0, 0.2));
  EXPECT_LT((plan.end_pose().position - Vector2(8.0, 0.0)).norm(), 1e-3);
}

TEST_F(LocalReplannerTest, APlanThatDoesNotJoinIsAskedForAgain) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 1.8}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  const auto elsewhere = step_on_track(kNow_s);
  EXPECT_FALSE(elsewhere.proposal);
  EXPECT_TRUE(elsewhere.request_plan);
  EXPECT_TRUE(elsewhere.renew_lease);  // it stands well
  EXPECT_NE(elsewhere.message.find("does not join"), std::string::npos);
}

TEST_F(LocalReplannerTest, APlanFromRestThatCameLateIsDrivenLater) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  for (const double late_s : {0.1, 1.0, 60.0}) {
    const Motion plan = straight_drive(kNow_s - late_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
    LocalReplanner replanner(robot_, rules_, default_local_rules());
    replanner.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
    replanner.set_plan(plan);
    const auto output = replanner.step(kNow_s, {kNow_s, {{0.0, 0.0}, 0.0}, {0.0, 0.0}}, scene_);
    ASSERT_TRUE(output.proposal) << output.message;
    const Motion& motion = output.proposal->motion;
    EXPECT_NEAR(motion.start_time(), kNow_s + rules_.settle_s, 1e-6);
    for (double t = 0.0; t < 3.0; t += 0.1) {
      const Vector2 expected = plan.at(plan.start_time() + t).pose.position;
      EXPECT_LT((motion.at(motion.start_time() + t).pose.position - expected).norm(), 1e-5);
    }
  }
}

TEST_F(LocalReplannerTest, FromRestItFindsIntoAPlanThatIsOnTheMove) {
  const Motion rolling = remainder(ahead_, kNow_s + 3.0);
  replanner_.set_committed(1, standing(kNow_s, rolling.at(kNow_s + 3.0).pose.position, 0.0));
  replanner_.set_plan(rolling);
  const auto output = step_on_track(kNow_s + 4.0);
  ASSERT_TRUE(output.proposal) << output.message;
  EXPECT_TRUE(output.proposal->motion.at(kNow_s).at_rest);
  EXPECT_FALSE(check_limits(output.proposal->motion, robot_.limits, kNow_s));
}

TEST_F(LocalReplannerTest, WhatLeadsNowhereIsNotProposed) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {-0.005, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {-0.005, 0.0}, 0.0, 8.0, 0.9, 0.5));
  OccupancyGrid grid = open_;
  fill_box(grid, {0.3, -3.0}, {12.0, 3.0}, OccupancyGrid::kUnknown);
  scene_ = {occupied_field(grid), unseen_field(grid), {}};
  const auto output = step_on_track(kNow_s);
  EXPECT_FALSE(output.proposal);
  EXPECT_TRUE(output.renew_lease);
  EXPECT_TRUE(output.request_plan);
  EXPECT_EQ(output.violation.term, ViolatedTerm::kUnseenSpace);
  EXPECT_NE(output.message.find("not seen free"), std::string::npos) << output.message;
}

TEST_F(LocalReplannerTest, ExtendsOnlyWhenEnoughIsUsedUp) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  const auto first = step_on_track(kNow_s);
  ASSERT_TRUE(first.proposal);
  replanner_.set_committed(first.proposal->sequence, first.proposal->motion);
  EXPECT_FALSE(step_on_track(kNow_s + 0.6).proposal);
  const auto second = step_on_track(kNow_s + rules_.extend_every_s + 0.1);
  ASSERT_TRUE(second.proposal);
  EXPECT_GT(second.proposal->sequence, first.proposal->sequence);
  EXPECT_GT(second.proposal->motion.end_pose().position.x(),
            first.proposal->motion.end_pose().position.x() + 0.5);
}

TEST_F(LocalReplannerTest, WaitsForAPeerAndSaysWhom) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  const auto stand = std::make_shared<const Motion>(standing(kNow_s - 9.0, {2.5, 0.0}, 0.0));
  scene_.others = {std::make_shared<PeerObstacle>("ugv2", stand, 0.3)};
  const auto output = step_on_track(kNow_s);
  EXPECT_EQ(output.reason, PlanReason::kPeerConflict);
  EXPECT_EQ(output.violation.peer, "ugv2");
  EXPECT_TRUE(output.request_plan);
}

TEST_F(LocalReplannerTest, SequencesGoOnAfterARestart) {
  replanner_.set_committed(41, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal);
  EXPECT_EQ(output.proposal->sequence, 42u);
}

TEST_F(LocalReplannerTest, AnOfferThatMeetsSomebodySoonerIsPassedOver) {
  const auto person_at = [](const Vector2& place) {
    return std::make_shared<PredictedDisc>("person", kNow_s, place, Vector2(0.0, 0.0), 0.25, 0.0);
  };
  // To the same place, but by way of somewhere else.
  PlanarMinco::State start = PlanarMinco::State::Zero();
  PlanarMinco::State end = PlanarMinco::State::Zero();
  start.col(2) << 0.3, 0.0;
  end.col(0) << 8.0, 0.0;
  end.col(2) << -0.3, 0.0;
  PlanarMinco minco;
  minco.resize(2);
  minco.solve(start, end, Vector2(4.0, 1.5), Eigen::Vector2d(6.0, 6.0));
  const Motion detour(kNow_s + 0.5, {DrivePhase{1, minco.curve()}});
  struct Case {
    std::vector<Vector2> people;
    bool keeps;
  };
  for (const Case& each : {Case{{}, false}, Case{{{4.0, 1.5}}, true}, Case{{{6.0, 0.0}}, false},
                           Case{{{1.8, 1.0}, {6.5, 0.0}}, true}}) {
    LocalReplanner replanner(robot_, rules_, default_local_rules());
    replanner.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
    replanner.set_plan(straight_drive(kNow_s + 0.5, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
    const auto first = replanner.step(kNow_s, {kNow_s, {}, {}}, scene_);
    ASSERT_TRUE(first.proposal);
    PromiseScene people = scene_;
    for (const Vector2& place : each.people) people.moving.push_back(person_at(place));
    people.predicted_until_s = kNow_s + 9.0;
    // The plan at hand counts as soon as it is proposed: else a new one would displace each swerve
    // before it is settled.
    for (const double now_s : {kNow_s + 0.1, kNow_s + 0.6}) {
      const bool is_settled = now_s > kNow_s + 0.5;
      LocalReplanner at_that_time = replanner;
      if (is_settled) at_that_time.set_committed(first.proposal->sequence, first.proposal->motion);
      at_that_time.set_plan(detour);
      const auto output = at_that_time.step(now_s, state(at_that_time.committed(), now_s), people);
      EXPECT_EQ(output.keeps_plan, each.keeps) << each.people.size() << ", " << is_settled;
    }
  }
}

/// Who stands in the way of somebody had better drive than look for a place to step to.
TEST_F(LocalReplannerTest, SetsOffInTimeBeforeWhoComesFromBehind) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.4, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  scene_.moving = {std::make_shared<PredictedDisc>("person", kNow_s, Vector2(-2.6, 0.05),
                                                   Vector2(0.7, 0.0), 0.25, 0.0)};
  scene_.predicted_until_s = kNow_s + 5.0;
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal) << output.message;
  EXPECT_FALSE(output.proposal->emergency);
  EXPECT_GT(output.proposal->motion.end_pose().position.x(), 2.0);
  EXPECT_EQ(replanner_.least_bad(), 0);
}

TEST_F(LocalReplannerTest, WithoutAPlanItJustStands) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  const auto output = step_on_track(kNow_s);
  EXPECT_TRUE(output.renew_lease);
  EXPECT_FALSE(output.proposal);
  EXPECT_FALSE(output.request_plan);
  replanner_.set_plan(Motion());
  EXPECT_FALSE(step_on_track(kNow_s + 0.1).proposal);
}

}  // namespace
}  // namespace mocha
