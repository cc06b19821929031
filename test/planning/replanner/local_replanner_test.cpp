#include "planning/replanner/local_replanner.h"

#include "fleet/wire/wire_format.h"
#include "planning/replanner/replanner_test.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

using LocalReplannerTest = ReplannerTest;

TEST_F(LocalReplannerTest, RenewsTheLeaseWhileItIsCertified) {
  replanner_.set_committed(1, ahead_);
  for (double t = kNow_s; t < ahead_.end_time() + 2.0; t += 0.1) {
    const auto output = step_on_track(t);
    EXPECT_TRUE(output.renew_lease);
    EXPECT_EQ(output.row, Row::kKeep) << to_text(output.row);
  }
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
  EXPECT_EQ(output.row, Row::kBrakeInTime) << to_text(output.row);
  EXPECT_FALSE(output.proposal->emergency);
  EXPECT_GE(output.proposal->motion.start_time(), now_s + options_.settle_s - 1e-6);
  EXPECT_LT(output.proposal->motion.end_pose().position.x(), 6.0 - 0.4);
}

TEST_F(LocalReplannerTest, BrakesAtOnceForAnObstacleThatIsClose) {
  replanner_.set_committed(1, ahead_);
  const double now_s = kNow_s + 4.0;
  const double here_x = ahead_.at(now_s).pose.position.x();
  // Farther than the stopping distance after emergency_time, but not after settle_time.
  block(std::ceil((here_x + 0.3 + 0.035 + 0.9 * 0.1 + 0.9 * 0.9 / (2.0 * 0.48) + 0.15) * 20.0) /
        20.0);
  const auto output = step_on_track(now_s);
  ASSERT_TRUE(output.proposal);
  EXPECT_EQ(output.row, Row::kBrakeInTimeAtOnce) << to_text(output.row);
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
  EXPECT_EQ(output.row, Row::kLastResort) << to_text(output.row);
  EXPECT_TRUE(output.proposal->emergency);
  EXPECT_NE(output.message.find("NO CERTIFIED MOTION"), std::string::npos) << output.message;
  EXPECT_LT(output.proposal->motion.end_time(), now_s + 3.0);
  EXPECT_EQ(replanner_.count(Row::kLastResort), 1);
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
  EXPECT_EQ(brake.row, Row::kBrakeInTime) << to_text(brake.row);
  const auto waits = step_on_track(now_s + 0.2);  // but says so only once
  EXPECT_FALSE(waits.proposal);
  EXPECT_EQ(waits.row, Row::kWait);
}

TEST_F(LocalReplannerTest, ProposesWhatTheOthersWillHold) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal);
  const Motion& motion = output.proposal->motion;
  const Motion heard = quantised(motion);
  for (double t = motion.start_time(); t < motion.end_time(); t += 0.1)
    EXPECT_EQ(heard.position(t), motion.position(t));
}

TEST_F(LocalReplannerTest, WaitsForAPeerAndSaysWhom) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
  const auto stand = std::make_shared<const Motion>(standing(kNow_s - 9.0, {2.5, 0.0}, 0.0));
  scene_.peers = {std::make_shared<PeerObstacle>("ugv2", stand, 0.3, test::kRoverBraking)};
  const auto output = step_on_track(kNow_s);
  EXPECT_EQ(output.reason, PlanReason::kPeerConflict);
  EXPECT_EQ(output.violation.peer, "ugv2");
  EXPECT_TRUE(output.request_plan);
}

TEST_F(LocalReplannerTest, SequencesGoOnAfterARestart) {
  replanner_.set_committed(41, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
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
    LocalReplanner replanner(robot_, options_, default_local_options());
    replanner.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
    replanner.set_plan(plan_from(kNow_s + 0.5));
    const auto first = replanner.step(kNow_s, {kNow_s, {}, {}}, scene_);
    ASSERT_TRUE(first.proposal);
    LocalScene people = scene_;
    for (const Vector2& place : each.people) people.confident.push_back(person_at(place));
    people.predicted_until_s = kNow_s + 9.0;
    // The plan at hand counts as soon as it is proposed: else a new one would displace each detour
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

/// A robot that stands in the way of a person had better drive than look for a place to step to.
TEST_F(LocalReplannerTest, SetsOffInTimeBeforeWhatComesFromBehind) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.4, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5));
  scene_.confident = {std::make_shared<PredictedDisc>("person", kNow_s, Vector2(-2.6, 0.05),
                                                      Vector2(0.7, 0.0), 0.25, 0.0)};
  scene_.predicted_until_s = kNow_s + 5.0;
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal) << output.message;
  EXPECT_EQ(output.row, Row::kFollow) << to_text(output.row);
  EXPECT_FALSE(output.proposal->emergency);
  EXPECT_GT(output.proposal->motion.end_pose().position.x(), 2.0);
  EXPECT_EQ(replanner_.count(Row::kLastResort), 0);
}

TEST_F(LocalReplannerTest, WithoutAPlanItJustStands) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  const auto output = step_on_track(kNow_s);
  EXPECT_TRUE(output.renew_lease);
  EXPECT_EQ(output.row, Row::kKeep) << to_text(output.row);
  EXPECT_FALSE(output.proposal);
  EXPECT_FALSE(output.request_plan);
  replanner_.set_plan(Motion());
  EXPECT_FALSE(step_on_track(kNow_s + 0.1).proposal);
}

}  // namespace
}  // namespace mocha
