#include "stack/commitment_keeping.h"

#include <gtest/gtest.h>

#include "fleet/protocol/motions.h"
#include "planning/late_answers.h"
#include "planning/worlds.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kLease_s = 0.5;
constexpr double kRadioRange_m = 30.0;

CommittedTrajectory wish(const Motion& motion, TrajectoryState state = TrajectoryState::kProposed,
                         const std::string& agent = "ugv1") {
  CommittedTrajectory trajectory;
  trajectory.agent = agent;
  trajectory.id = {1, 1};
  trajectory.state = state;
  trajectory.footprint_radius_m = 0.3;
  trajectory.braking = test::kRoverBraking;
  trajectory.motion = std::make_shared<const Motion>(motion);
  return trajectory;
}

class CommitmentKeepingTest : public ::testing::Test {
 protected:
  /// Has a drive along x settled, under that number.
  Settled commit(std::uint32_t sequence, double now_s) {
    keeping_.propose(sequence, wish(drive_), now_s);
    const CommitmentNews news = keeping_.tick(now_s);
    EXPECT_EQ(news.settled.size(), 1u);
    return news.settled.at(0);
  }

  const Motion drive_ = straight_drive(kNow_s + 0.3, {0.0, 0.0}, 0.0, 4.0, 0.9, 0.5);
  LateAnswers protocol_;
  CommitmentKeeping keeping_{rover(), kLease_s, kRadioRange_m, protocol_};
};

TEST_F(CommitmentKeepingTest, WhatIsBindingHasTheProposersNumberAndAFirstLease) {
  const Settled settled = commit(7, kNow_s);
  ASSERT_TRUE(settled.in_force);
  EXPECT_EQ(settled.sequence, 7u);
  EXPECT_EQ(settled.in_force->lease.id, (MotionId{1, 7}));
  EXPECT_DOUBLE_EQ(settled.in_force->lease.end_s, kNow_s + kLease_s);
  EXPECT_DOUBLE_EQ(keeping_.lease_end_s(), kNow_s + kLease_s);
  EXPECT_LT((settled.in_force->trajectory.motion->end_pose().position - Vector2(4.0, 0.0)).norm(),
            0.01);
}

TEST_F(CommitmentKeepingTest, BrakingIsPromisedAsTheOthersHearIt) {
  CommittedTrajectory promised = wish(drive_);
  promised.braking = Braking(0.48012, 0.7999);
  keeping_.propose(7, promised, kNow_s);
  const CommitmentNews news = keeping_.tick(kNow_s);
  ASSERT_EQ(news.settled.size(), 1u);
  const Braking braking = news.settled[0].event.trajectory.braking.value();
  EXPECT_DOUBLE_EQ(braking.deceleration(), 0.48);
  EXPECT_DOUBLE_EQ(braking.max_acceleration(), 0.8);
}

TEST_F(CommitmentKeepingTest, ARefusalIsToldWithItsNumberAndCounted) {
  protocol_.refused_share = 1.0;
  const Settled settled = commit(8, kNow_s);
  EXPECT_FALSE(settled.in_force);
  EXPECT_EQ(settled.sequence, 8u);
  EXPECT_EQ(settled.event.kind, CommitmentEvent::Kind::kRejected);
  EXPECT_EQ(keeping_.counts().refusals.at("peer_promise"), 1);
}

TEST_F(CommitmentKeepingTest, WhereTheLeaseEndsTheStopIsPromised) {
  commit(7, kNow_s);
  const double end_s = kNow_s + 2.0;
  keeping_.renew({{1, 7}, end_s});
  keeping_.renew({{1, 6}, end_s + 9.0});  // of another motion
  EXPECT_FALSE(keeping_.tick(end_s - 0.01).lease_ended);
  const CommitmentNews news = keeping_.tick(end_s + 0.02);
  EXPECT_EQ(news.lease_ended, 7u);
  EXPECT_EQ(news.unsaid, "");
  ASSERT_EQ(news.settled.size(), 1u);
  ASSERT_TRUE(news.settled[0].in_force);
  EXPECT_GT(news.settled[0].sequence, 7u);
  EXPECT_EQ(news.settled[0].event.trajectory.braking->deceleration(),
            rover().braking().deceleration());
  const Motion& stop = *news.settled[0].in_force->trajectory.motion;
  EXPECT_LT(stop.end_time(), drive_.end_time() - 1.0);
  EXPECT_EQ(keeping_.counts().lease_stops, 1);
}

TEST_F(CommitmentKeepingTest, WhatWasProposedBeforeTheLeaseEndedIsRefused) {
  commit(7, kNow_s);
  const CommitmentNews news = keeping_.tick(kNow_s + 1.0);
  const std::uint32_t stop = news.settled.at(0).sequence;
  EXPECT_THROW(keeping_.propose(stop, wish(drive_), kNow_s + 1.0), std::invalid_argument);
  EXPECT_NO_THROW(keeping_.propose(stop + 1, wish(drive_), kNow_s + 1.0));
}

TEST_F(CommitmentKeepingTest, StoppedForAnEmergencyItPromisesEmergencyMotionsAlone) {
  EXPECT_THROW(keeping_.propose(1, wish(drive_), kNow_s, "stopped"), std::invalid_argument);
  EXPECT_NO_THROW(
      keeping_.propose(2, wish(drive_, TrajectoryState::kEmergency), kNow_s, "stopped"));
  EXPECT_THROW(keeping_.propose(3, wish(drive_, TrajectoryState::kCommitted), kNow_s),
               std::invalid_argument);
}

TEST_F(CommitmentKeepingTest, StartedAnewItPromisesTheRestOfWhatIsDriven) {
  CommittedTrajectory driven = wish(drive_, TrajectoryState::kCommitted);
  driven.id = {4, 17};
  const double now_s = kNow_s + 2.0;
  keeping_.resume(driven, now_s);
  const CommitmentNews news = keeping_.tick(now_s);
  ASSERT_EQ(news.settled.size(), 1u);
  ASSERT_TRUE(news.settled[0].in_force);
  EXPECT_EQ(news.settled[0].in_force->lease.id, (MotionId{1, 17}));
  const Motion& rest = *protocol_.binding().newest().motion;
  EXPECT_DOUBLE_EQ(rest.start_time(), now_s);
  for (double t = now_s; t < drive_.end_time() + 1.0; t += 0.1)
    EXPECT_LT((rest.position(t) - drive_.position(t)).norm(), 0.01) << t;
}

TEST_F(CommitmentKeepingTest, StartedAnewItPromisesToStandWhereItsMotionHasEnded) {
  keeping_.resume(wish(drive_, TrajectoryState::kCommitted), drive_.end_time() + 5.0);
  const Motion& rest =
      *keeping_.tick(drive_.end_time() + 5.0).settled.at(0).in_force->trajectory.motion;
  EXPECT_TRUE(rest.at(rest.start_time()).at_rest);
  EXPECT_LT((rest.end_pose().position - drive_.end_pose().position).norm(), 0.01);
}

TEST_F(CommitmentKeepingTest, TellsThePeersPromisesWhenTheyChangeAndNowAndThen) {
  ASSERT_TRUE(keeping_.fleet_news(kNow_s));
  EXPECT_FALSE(keeping_.fleet_news(kNow_s + 0.1));
  keeping_.receive(wish(drive_, TrajectoryState::kCommitted, "ugv2"), kNow_s + 0.1);
  const auto news = keeping_.fleet_news(kNow_s + 0.1);
  ASSERT_TRUE(news);
  ASSERT_EQ(news->size(), 1u);
  EXPECT_EQ(news->at(0).agent, "ugv2");
  EXPECT_FALSE(keeping_.fleet_news(kNow_s + 0.1 + 0.99 * kFleetPeriod_s));
  EXPECT_TRUE(keeping_.fleet_news(kNow_s + 0.1 + kFleetPeriod_s));
}

}  // namespace
}  // namespace mocha
