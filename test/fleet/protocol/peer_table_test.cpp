#include "fleet/protocol/peer_table.h"

#include <gtest/gtest.h>

#include "fleet/protocol/motions.h"
#include "trajectory/rover_braking.h"
#include "trajectory/separation.h"

namespace mocha {
namespace {

using Verdict = PeerTable::Verdict;

constexpr ClockOptions kClocks{0.0, 0.25};

CommittedTrajectory trajectory(TrajectoryId id, TrajectoryState state, double start_s = 10.0) {
  CommittedTrajectory trajectory;
  trajectory.agent = "a";
  trajectory.id = id;
  trajectory.state = state;
  trajectory.footprint_radius_m = 0.3;
  trajectory.braking = test::kRoverBraking;
  if (state != TrajectoryState::kWithdrawn) {
    trajectory.motion = test::shared(test::drive(start_s, {{0.0, 0.0}, {4.0, 0.0}}, 1.0));
  }
  return trajectory;
}

Heartbeat heartbeat(std::uint32_t epoch, std::vector<Acknowledgement> acknowledgements = {}) {
  return {"a", epoch, 0.0, std::move(acknowledgements), {}};
}

class PeerTableTest : public ::testing::Test {
 protected:
  const Peer& peer() const { return table_.peers().at("a"); }
  PeerTable table_{"me", 3, 1.0, kClocks};
};

TEST_F(PeerTableTest, KeepsTheNewestAndCountsTheRest) {
  using State = TrajectoryState;
  EXPECT_EQ(table_.receive(trajectory({1, 2}, State::kProposed), 0.0), Verdict::kNews);
  EXPECT_EQ(table_.receive(trajectory({1, 2}, State::kProposed), 0.1), Verdict::kDuplicate);
  EXPECT_EQ(table_.receive(trajectory({1, 1}, State::kProposed), 0.2), Verdict::kOld);
  EXPECT_EQ(table_.receive(trajectory({1, 2}, State::kCommitted), 0.3), Verdict::kNews);
  EXPECT_EQ(table_.receive(trajectory({1, 2}, State::kCommitted), 0.4), Verdict::kDuplicate);
  EXPECT_EQ(table_.receive(trajectory({1, 2}, State::kProposed), 0.5), Verdict::kDuplicate);
  EXPECT_EQ(table_.receive(trajectory({1, 1}, State::kCommitted), 0.6), Verdict::kOld);
  EXPECT_EQ(peer().binding.newest().id, (TrajectoryId{1, 2}));
  EXPECT_TRUE(peer().open.empty());
  EXPECT_EQ(table_.duplicates(), 3);
  EXPECT_EQ(table_.old_messages(), 2);
  EXPECT_DOUBLE_EQ(peer().last_heard_s, 0.6);
}

TEST_F(PeerTableTest, WhatIsInForceUntilTheNextPromiseBeginsMayComeAfterThat) {
  table_.receive(trajectory({1, 2}, TrajectoryState::kCommitted, 20.0), 0.0);
  EXPECT_EQ(table_.receive(trajectory({1, 1}, TrajectoryState::kCommitted), 0.1), Verdict::kNews);
  EXPECT_EQ(table_.receive(trajectory({1, 1}, TrajectoryState::kCommitted), 0.2),
            Verdict::kDuplicate);
  EXPECT_EQ(peer().binding.newest().id, (TrajectoryId{1, 2}));
  ASSERT_EQ(peer().binding.reservations().size(), 2u);
  EXPECT_DOUBLE_EQ(peer().binding.reservations()[0].until_s, 20.0);
}

TEST_F(PeerTableTest, AWithdrawalMayOvertakeItsProposal) {
  EXPECT_EQ(table_.receive(trajectory({1, 1}, TrajectoryState::kWithdrawn), 0.0), Verdict::kNews);
  EXPECT_EQ(table_.receive(trajectory({1, 1}, TrajectoryState::kProposed), 0.0),
            Verdict::kDuplicate);
  EXPECT_EQ(table_.receive(trajectory({1, 1}, TrajectoryState::kWithdrawn), 0.0),
            Verdict::kDuplicate);
  EXPECT_EQ(peer().unanswered(), nullptr);
}

TEST_F(PeerTableTest, AnOlderProposalStaysUntilItsFateIsKnown) {
  table_.receive(trajectory({1, 1}, TrajectoryState::kProposed), 0.0);
  table_.receive(trajectory({1, 2}, TrajectoryState::kProposed), 0.0);
  EXPECT_EQ(peer().open.size(), 2u);
  ASSERT_NE(peer().unanswered(), nullptr);
  EXPECT_EQ(peer().unanswered()->id.sequence, 2u);

  PeerTable replaced = table_;  // the first was replaced before it was binding
  const Heartbeat tells = heartbeat(1, {{"a", {1, 2}, TrajectoryState::kProposed}});
  EXPECT_EQ(replaced.receive(tells, 0.1), Verdict::kNews);
  EXPECT_EQ(replaced.receive(tells, 0.1), Verdict::kAlive);
  ASSERT_EQ(replaced.peers().at("a").open.size(), 1u);
  EXPECT_EQ(replaced.peers().at("a").open[0].id.sequence, 2u);
  EXPECT_TRUE(replaced.peers().at("a").binding.empty());

  table_.receive(
      heartbeat(1, {{"a", {1, 1}, TrajectoryState::kCommitted},  // it became binding, unheard
                    {"a", {1, 2}, TrajectoryState::kWithdrawn}}),
      0.1);
  EXPECT_TRUE(peer().open.empty());
  ASSERT_FALSE(peer().binding.empty());
  EXPECT_EQ(peer().binding.newest().id.sequence, 1u);
  EXPECT_EQ(peer().binding.newest().state, TrajectoryState::kCommitted);
}

TEST_F(PeerTableTest, ALateHeartbeatChangesNothing) {
  table_.receive(trajectory({1, 1}, TrajectoryState::kProposed), 0.0);
  table_.receive(trajectory({1, 2}, TrajectoryState::kCommitted, 20.0), 0.0);
  table_.receive(trajectory({1, 3}, TrajectoryState::kProposed, 30.0), 0.0);
  table_.receive(heartbeat(1, {{"a", {1, 1}, TrajectoryState::kCommitted}}), 0.1);
  EXPECT_EQ(peer().binding.newest().id.sequence, 2u);
  ASSERT_EQ(peer().open.size(), 2u);  // 1 may be in force until 2 starts
  EXPECT_DOUBLE_EQ(peer().reservation_of_open(peer().open[0]).until_s, 20.0);
  table_.prune(20.0);
  ASSERT_EQ(peer().open.size(), 0u);  // and 3 went with the silence
}

TEST_F(PeerTableTest, ReachIsByHeartbeat) {
  table_.receive(trajectory({1, 1}, TrajectoryState::kCommitted), 5.0);
  EXPECT_FALSE(table_.in_reach(peer(), 5.0));
  table_.receive(heartbeat(1), 5.0);
  EXPECT_TRUE(table_.in_reach(peer(), 6.0));
  EXPECT_FALSE(table_.in_reach(peer(), 6.01));
  ASSERT_TRUE(table_.acknowledgement("a", 6.0));
  EXPECT_EQ(table_.acknowledgement("a", 6.0)->id, (TrajectoryId{1, 1}));
  EXPECT_FALSE(table_.acknowledgement("a", 6.01));
  table_.prune(1000.0);
  EXPECT_NEAR(peer().binding.position(1000.0).x(), 4.0, 1e-6);  // an obstacle at its last place
}

TEST_F(PeerTableTest, OfASilentPeerOnlyEndorsedProposalsStay) {
  table_.receive(trajectory({1, 1}, TrajectoryState::kProposed), 0.0);
  table_.endorse("a", peer().open[0]);
  table_.receive(trajectory({1, 2}, TrajectoryState::kProposed), 0.0);
  table_.prune(0.9);
  EXPECT_EQ(peer().open.size(), 2u);
  table_.prune(1.1);
  ASSERT_EQ(peer().open.size(), 1u);
  EXPECT_EQ(peer().open[0].id.sequence, 1u);
}

TEST_F(PeerTableTest, AHigherEpochMakesFormerMessagesOld) {
  table_.receive(trajectory({1, 8}, TrajectoryState::kCommitted), 0.0);
  table_.receive(heartbeat(1, {{"me", {3, 4}, TrajectoryState::kProposed}}), 0.0);
  ASSERT_TRUE(peer().of_us);
  table_.receive(heartbeat(2), 0.5);
  EXPECT_FALSE(peer().of_us);
  EXPECT_EQ(peer().binding.newest().id, (TrajectoryId{1, 8}));  // it has not vanished
  EXPECT_EQ(table_.receive(trajectory({1, 10}, TrajectoryState::kProposed), 0.6), Verdict::kOld);
  EXPECT_EQ(table_.receive(heartbeat(1), 0.6), Verdict::kOld);
  // It is told what it is known as.
  ASSERT_TRUE(table_.acknowledgement("a", 0.6));
  EXPECT_EQ(table_.acknowledgement("a", 0.6)->agent, "a");
  EXPECT_EQ(table_.acknowledgement("a", 0.6)->id, (TrajectoryId{2, 0}));
  EXPECT_FALSE(table_.acknowledgement("a", 1.7));
  EXPECT_EQ(table_.receive(trajectory({2, 1}, TrajectoryState::kProposed, 11.0), 0.7),
            Verdict::kNews);
  EXPECT_NE(peer().unanswered(), nullptr);
  EXPECT_EQ(table_.receive(trajectory({2, 1}, TrajectoryState::kCommitted, 11.0), 0.8),
            Verdict::kNews);
  EXPECT_EQ(peer().binding.newest().id, (TrajectoryId{2, 1}));
  EXPECT_EQ(table_.receive(trajectory({1, 10}, TrajectoryState::kCommitted, 12.0), 0.9),
            Verdict::kOld);
}

TEST_F(PeerTableTest, WhatAFormerEpochBoundCountsUntilTheNewOneBindsSomething) {
  table_.receive(trajectory({1, 8}, TrajectoryState::kCommitted), 0.0);
  table_.receive(trajectory({1, 9}, TrajectoryState::kProposed, 20.0), 0.0);
  table_.receive(heartbeat(2), 0.5);
  EXPECT_EQ(peer().open.size(), 1u);  // it may have become binding
  EXPECT_EQ(peer().unanswered(), nullptr);
  PeerTable told = table_;  // that it has, by a heartbeat that comes late
  EXPECT_EQ(told.receive(heartbeat(1, {{"a", {1, 9}, TrajectoryState::kCommitted}}), 0.6),
            Verdict::kNews);
  EXPECT_EQ(told.peers().at("a").binding.newest().id, (TrajectoryId{1, 9}));
  EXPECT_EQ(table_.receive(trajectory({1, 10}, TrajectoryState::kCommitted, 15.0), 0.6),
            Verdict::kNews);
  EXPECT_EQ(peer().binding.newest().id, (TrajectoryId{1, 10}));
  EXPECT_EQ(peer().epoch, 2u);
  EXPECT_TRUE(table_.acknowledgement("a", 0.6)->id == (TrajectoryId{2, 0}));
  table_.receive(trajectory({2, 1}, TrajectoryState::kEmergency, 12.0), 0.7);
  EXPECT_EQ(peer().binding.newest().id, (TrajectoryId{2, 1}));
  table_.receive(heartbeat(2), 12.0);
  table_.prune(12.0);
  EXPECT_EQ(peer().binding.reservations().size(), 1u);
}

TEST_F(PeerTableTest, AFormerProposalThatWeDidNotEndorseStaysToItsEnd) {
  table_.receive(trajectory({1, 1}, TrajectoryState::kProposed), 0.0);
  const double end_s = peer().open[0].motion->end_time();
  table_.receive(heartbeat(2), end_s - 0.1);
  table_.prune(end_s - 0.1);
  EXPECT_EQ(peer().open.size(), 1u);
  table_.prune(end_s);
  EXPECT_TRUE(peer().open.empty());
}

TEST_F(PeerTableTest, AProposalThatIsHeardAgainAfterASilenceIsNews) {
  table_.receive(trajectory({1, 1}, TrajectoryState::kProposed), 0.0);
  table_.prune(1.1);
  EXPECT_TRUE(peer().open.empty());
  EXPECT_EQ(table_.receive(trajectory({1, 1}, TrajectoryState::kProposed), 1.2), Verdict::kNews);
  EXPECT_NE(peer().unanswered(), nullptr);
}

TEST_F(PeerTableTest, ReadsOnlyWhatConcernsThisEpochOfUs) {
  table_.receive(heartbeat(1, {{"me", {2, 9}, TrajectoryState::kProposed},
                               {"you", {3, 9}, TrajectoryState::kProposed}}),
                 0.0);
  EXPECT_FALSE(peer().of_us);
  table_.receive(heartbeat(1, {{"me", {3, 5}, TrajectoryState::kProposed}}), 0.0);
  table_.receive(heartbeat(1, {{"me", {3, 4}, TrajectoryState::kCommitted}}), 0.1);  // overtaken
  ASSERT_TRUE(peer().of_us);
  EXPECT_EQ(peer().of_us->id.sequence, 5u);
}

TEST_F(PeerTableTest, HearsOfALaterEpochOfItself) {
  table_.receive(heartbeat(1, {{"me", {3, 5}, TrajectoryState::kProposed}}), 0.0);
  EXPECT_EQ(table_.known_epoch(), 3u);
  table_.receive(heartbeat(1, {{"me", {12, 0}, TrajectoryState::kProposed}}), 0.1);
  EXPECT_EQ(table_.known_epoch(), 12u);
}

TEST_F(PeerTableTest, DoesNotBelieveInMoreStartsThanThereCanHaveBeen) {
  const auto tell = [](PeerTable& table, std::uint32_t epoch) {
    table.receive(heartbeat(1, {{"me", {epoch, 0}, TrajectoryState::kProposed}}), 0.0);
  };
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  tell(table_, kMost);
  tell(table_, 3 + PeerTable::kMostStarts + 1);
  EXPECT_EQ(table_.known_epoch(), 0u);
  EXPECT_EQ(table_.unlikely_epochs(), 2);
  tell(table_, 3 + PeerTable::kMostStarts);
  EXPECT_EQ(table_.known_epoch(), 3 + PeerTable::kMostStarts);
  // Not step by step to the end of the numbers, either.
  PeerTable late("me", kMost - PeerTable::kMostStarts - 5, 1.0, kClocks);
  tell(late, kMost - PeerTable::kMostStarts + 1);
  EXPECT_EQ(late.known_epoch(), 0u);
  tell(late, kMost - PeerTable::kMostStarts);
  EXPECT_EQ(late.known_epoch(), kMost - PeerTable::kMostStarts);
  EXPECT_EQ(late.unlikely_epochs(), 1);
}

/// Its clock is ahead by 3 s, messages take 0.05 s either way.
Heartbeat echoed(double sent_s) { return {"a", 1, sent_s + 0.05 + 3.0, {}, {{"me", sent_s, 0.0}}}; }

TEST_F(PeerTableTest, TellsPromisesByItsOwnClock) {
  table_.receive(trajectory({1, 1}, TrajectoryState::kCommitted, 13.0), 8.0);
  table_.receive(trajectory({1, 2}, TrajectoryState::kProposed, 14.0), 8.0);
  EXPECT_FALSE(table_.clock_known(peer(), 8.0));
  EXPECT_EQ(table_.receive(echoed(8.0), 8.1), Verdict::kNews);
  EXPECT_TRUE(table_.clock_known(peer(), 8.1));
  EXPECT_NEAR(peer().binding.newest().motion->start_time(), 10.0, 1e-9);  // heard before
  EXPECT_NEAR(peer().open.at(0).motion->start_time(), 11.0, 1e-9);
  table_.receive(trajectory({1, 3}, TrajectoryState::kCommitted, 15.0), 8.2);
  EXPECT_NEAR(peer().binding.newest().motion->start_time(), 12.0, 1e-9);
  // 0.05 s and the clocks' resolution.
  EXPECT_NEAR(table_.mistimed_s(peer(), 8.2), 0.07, 1e-4);
  EXPECT_TRUE(table_.clock_differs(peer(), 8.2));
  // The clock is set right.
  table_.receive(Heartbeat{"a", 1, 9.05, {}, {{"me", 9.0, 0.0}}}, 9.1);
  EXPECT_NEAR(peer().binding.newest().motion->start_time(), 15.0, 1e-9);
  EXPECT_FALSE(table_.clock_differs(peer(), 9.1));
}

TEST(PeerTable, WhatTheToleranceLeavesOpenOfAnUncertainClockCounts) {
  for (const double ahead_s : {0.0, 0.1, -0.1}) {
    PeerTable table("me", 3, 1.0, {0.05, 0.25});
    table.receive(Heartbeat{"a", 1, 8.05 + ahead_s, {}, {{"me", 8.0, 0.0}}}, 8.1);
    const Peer& a = table.peers().at("a");
    EXPECT_NEAR(a.clock.ahead_s(), ahead_s, 1e-6);  // what is most likely
    EXPECT_NEAR(table.mistimed_s(a, 8.1), 0.05 + ClockEstimate::kResolution_s - 0.05, 1e-6);
    EXPECT_NEAR(table.mistimed_s(a, 18.1), 0.02 + 10.0 * ClockEstimate::kDrift, 1e-6);
    EXPECT_FALSE(table.clock_differs(a, 8.1));
    EXPECT_TRUE(table.clock_known(a, 8.1));
  }
}

TEST(PeerTable, AClockThatCannotBeToldIsNotKnown) {
  PeerTable table("me", 3, 1.0, kClocks);
  table.receive(Heartbeat{"a", 1, 12.0, {}, {{"me", 8.0, 0.0}}},
                8.6);  // 3.7 s ahead, or 0.3 s less
  EXPECT_FALSE(table.clock_known(table.peers().at("a"), 8.6));
  table.receive(Heartbeat{"a", 1, 12.6, {}, {{"me", 8.8, 0.0}}}, 9.0);
  EXPECT_TRUE(table.clock_known(table.peers().at("a"), 9.0));
}

TEST(PeerTable, EchoesTheNewestHeartbeatOfEachPeer) {
  PeerTable table("me", 3, 1.0, kClocks);
  table.receive(Heartbeat{"a", 1, 20.0, {}, {}}, 8.0);
  table.receive(Heartbeat{"b", 1, 30.0, {}, {}}, 8.1);
  table.receive(Heartbeat{"a", 1, 20.1, {}, {}}, 8.1);
  table.receive(Heartbeat{"a", 1, 19.9, {}, {}}, 8.2);  // overtaken
  const auto echo = table.echo("a", 8.3);
  ASSERT_TRUE(echo);
  EXPECT_EQ(echo->agent, "a");
  EXPECT_EQ(echo->stamp_s, 20.1);
  EXPECT_NEAR(echo->held_s, 0.2, 1e-9);
  EXPECT_TRUE(table.echo("b", 8.3));
  EXPECT_FALSE(table.echo("a", 9.5));
}

TEST(PeerTable, InventedNamesTakeNoMoreMemoryThanAFleet) {
  PeerTable table("me", 3, 1.0, kClocks);
  for (std::size_t i = 0; i < PeerTable::kMostPeers + 750; ++i)
    table.receive(Heartbeat{"invented" + std::to_string(i), 1, 20.0, {}, {}}, 8.0);
  EXPECT_EQ(table.peers().size(), PeerTable::kMostPeers);
  EXPECT_EQ(table.crowded_out(), 750);
  EXPECT_EQ(table.receive(Heartbeat{"invented1", 1, 20.1, {}, {}}, 8.1), Verdict::kAlive);
}

TEST(PeerTable, RefusesABadTimeout) {
  EXPECT_THROW(PeerTable("me", 1, 0.0, kClocks), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
