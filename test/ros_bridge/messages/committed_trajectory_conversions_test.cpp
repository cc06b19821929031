#include "ros_bridge/messages/committed_trajectory_conversions.h"

#include <gtest/gtest.h>

#include <limits>

#include "fleet/protocol/motions.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

CommittedTrajectory trajectory() {
  CommittedTrajectory trajectory;
  trajectory.agent = "ugv1";
  trajectory.id = {4, 17};
  trajectory.state = TrajectoryState::kCommitted;
  trajectory.priority = -2;
  trajectory.footprint_radius_m = 0.3;
  trajectory.braking = test::kRoverBraking;
  trajectory.motion = test::shared(test::drive(12.5, {{0.0, 1.0}, {2.0, 1.5}, {4.0, 0.0}}, 1.0));
  return trajectory;
}

TEST(PromiseConversions, GoThereAndBack) {
  const auto message = to_message(trajectory(), "map", ros::Time(12.0));
  const CommittedTrajectory back = trajectory_from_message(message, "map");
  EXPECT_EQ(back.agent, "ugv1");
  EXPECT_EQ(back.id, (TrajectoryId{4, 17}));
  EXPECT_EQ(back.state, TrajectoryState::kCommitted);
  EXPECT_EQ(back.priority, -2);
  EXPECT_DOUBLE_EQ(back.footprint_radius_m, 0.3);
  EXPECT_EQ(back.braking->deceleration(), test::kRoverBraking.deceleration());
  EXPECT_EQ(back.braking->max_acceleration(), test::kRoverBraking.max_acceleration());
  for (double t = 12.0; t < 18.0; t += 0.1) {
    const Vector2 expected = trajectory().motion->at(t).pose.position;
    EXPECT_NEAR((back.motion->at(t).pose.position - expected).norm(), 0.0, 1e-9);
  }
  const Heartbeat heartbeat{
      "ugv2", 3, 12.0, {{"ugv1", {4, 17}, TrajectoryState::kEmergency}}, {{"ugv1", 11.5, 0.25}}};
  const Heartbeat heard = heartbeat_from_message(to_message(heartbeat, "map", ros::Time(12.0)));
  EXPECT_EQ(heard.agent, "ugv2");
  EXPECT_EQ(heard.epoch, 3u);
  ASSERT_EQ(heard.acknowledgements.size(), 1u);
  EXPECT_EQ(heard.acknowledgements[0].agent, "ugv1");
  EXPECT_EQ(heard.acknowledgements[0].id, (TrajectoryId{4, 17}));
  EXPECT_EQ(heard.acknowledgements[0].state, TrajectoryState::kEmergency);
  EXPECT_EQ(heard.stamp_s, 12.0);
  ASSERT_EQ(heard.echoes.size(), 1u);
  EXPECT_EQ(heard.echoes[0].agent, "ugv1");
  EXPECT_EQ(heard.echoes[0].stamp_s, 11.5);
  EXPECT_EQ(heard.echoes[0].held_s, 0.25);
}

TEST(PromiseConversions, BrakingMayBeTheSameInBends) {
  CommittedTrajectory anywhere = trajectory();
  anywhere.braking = Braking(0.5);
  const auto message = to_message(anywhere, "map", ros::Time(12.0));
  EXPECT_EQ(trajectory_from_message(message, "map").braking->max_acceleration(),
            std::numeric_limits<double>::infinity());
}

TEST(PromiseConversions, AWithdrawalNeedsNoMotion) {
  CommittedTrajectory withdrawn = trajectory();
  withdrawn.state = TrajectoryState::kWithdrawn;
  withdrawn.braking.reset();
  withdrawn.motion.reset();
  const auto message = to_message(withdrawn, "map", ros::Time(12.0));
  EXPECT_EQ(trajectory_from_message(message, "map").state, TrajectoryState::kWithdrawn);
}

TEST(PromiseConversions, RefuseWhatNobodyCanHaveMeant) {
  const auto good = to_message(trajectory(), "map", ros::Time(12.0));
  const auto refused = [&](auto change) {
    auto message = good;
    change(message);
    EXPECT_THROW(trajectory_from_message(message, "map"), std::invalid_argument);
  };
  refused([](auto& m) { m.header.frame_id = "odom"; });
  refused([](auto& m) { m.agent.clear(); });
  refused([](auto& m) { m.sequence = 0; });
  refused([](auto& m) { m.state = mocha_ugv::Trajectory::PLANNED; });
  refused([](auto& m) { m.state = 5; });
  refused([](auto& m) { m.footprint_radius = 0.0; });
  refused([](auto& m) { m.footprint_radius = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& m) { m.footprint_radius = 11.0; });
  for (const double odd : {0.0, -0.5, 0.01, 51.0, std::numeric_limits<double>::quiet_NaN()}) {
    refused([odd](auto& m) { m.deceleration = odd; });
    refused([odd](auto& m) { m.max_acceleration = odd; });
  }
  refused([](auto& m) { m.deceleration = std::numeric_limits<double>::infinity(); });
  refused([](auto& m) { m.phases.clear(); });
  refused([](auto& m) { m.phases[0].x[1] = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& m) { m.phases[0].durations[0] = 1e-3; });  // far too fast
  refused([](auto& m) { m.phases[0].durations[0] = 1e9; });
  mocha_ugv::Heartbeat heartbeat;
  EXPECT_THROW(heartbeat_from_message(heartbeat), std::invalid_argument);
  heartbeat.agent = "ugv1";
  heartbeat.acknowledgements.resize(1);
  EXPECT_THROW(heartbeat_from_message(heartbeat), std::invalid_argument);
}

TEST(PromiseConversions, SettlementsSayWhichProposalWhatWhereWhenAndByHowMuch) {
  using mocha_ugv::Settlement;
  CommitmentEvent event;
  event.kind = CommitmentEvent::Kind::kRejected;
  event.refusal = Refusal::kPeerPromise;
  event.trajectory.id = {4, 99};
  event.proposal.tag = 23;
  event.conflict = {"ugv2", 14.25, 0.31, 0.8, {1.5, -2.0}};
  const auto rejected =
      settlement_of({event, event.proposal.tag, std::nullopt}, "map", ros::Time(12.0));
  EXPECT_EQ(rejected.header.stamp, ros::Time(12.0));
  EXPECT_EQ(rejected.header.frame_id, "map");
  EXPECT_EQ(rejected.result, Settlement::REJECTED);
  EXPECT_EQ(rejected.refusal, Settlement::PEER_PROMISE);
  EXPECT_EQ(rejected.epoch, 4u);
  EXPECT_EQ(rejected.sequence, 23u);
  EXPECT_EQ(rejected.peer, "ugv2");
  EXPECT_DOUBLE_EQ(rejected.at.toSec(), 14.25);
  EXPECT_DOUBLE_EQ(rejected.place.x, 1.5);
  EXPECT_DOUBLE_EQ(rejected.place.y, -2.0);
  EXPECT_DOUBLE_EQ(rejected.distance, 0.31);
  EXPECT_DOUBLE_EQ(rejected.required, 0.8);
  for (const char* part : {"0.31 m", "ugv2", "0.80 m", "(1.50, -2.00)", "14.25 s"}) {
    EXPECT_NE(rejected.message.find(part), std::string::npos) << rejected.message;
  }
  event.kind = CommitmentEvent::Kind::kBreached;
  event.refusal = Refusal::kNone;
  const auto breached = settlement_of({event, 22, std::nullopt}, "map", ros::Time(12.0));
  EXPECT_EQ(breached.result, Settlement::BREACHED);
  EXPECT_EQ(breached.refusal, Settlement::NONE);
  EXPECT_EQ(breached.peer, "ugv2");
  EXPECT_EQ(breached.sequence, 22u);
  event = CommitmentEvent();
  event.proposal.tag = 24;
  const auto settled =
      settlement_of({event, event.proposal.tag, std::nullopt}, "map", ros::Time(12.0));
  EXPECT_EQ(settled.result, Settlement::SETTLED);
  EXPECT_EQ(settled.sequence, 24u);
  EXPECT_EQ(settled.message, "is binding");
}

TEST(PromiseConversions, TheProposerHearsWhetherItIsSettledRefusedOrBreached) {
  mocha_ugv::Settlement settlement;
  settlement.sequence = 23;
  settlement.message = "too late";
  const std::vector<std::pair<std::uint8_t, Answer::Kind>> kinds = {
      {mocha_ugv::Settlement::SETTLED, Answer::Kind::kSettled},
      {mocha_ugv::Settlement::REJECTED, Answer::Kind::kRefused},
      {mocha_ugv::Settlement::INVALID, Answer::Kind::kRefused},
      {mocha_ugv::Settlement::BREACHED, Answer::Kind::kBreached}};
  for (const auto& [result, kind] : kinds) {
    settlement.result = result;
    const Answer answer = answer_from_message(settlement);
    EXPECT_EQ(answer.kind, kind);
    EXPECT_EQ(answer.sequence, 23u);
    EXPECT_EQ(answer.words, "too late");
  }
}

TEST(PromiseConversions, SettlementsNumberRefusalsAsTheProtocolDoes) {
  using mocha_ugv::Settlement;
  const std::vector<std::pair<Refusal, std::uint8_t>> numbers = {
      {Refusal::kNone, Settlement::NONE},
      {Refusal::kListening, Settlement::LISTENING},
      {Refusal::kTooLate, Settlement::TOO_LATE},
      {Refusal::kDiscontinuous, Settlement::DISCONTINUOUS},
      {Refusal::kPeerPromise, Settlement::PEER_PROMISE},
      {Refusal::kPeerProposal, Settlement::PEER_PROPOSAL},
      {Refusal::kUnanswered, Settlement::UNANSWERED},
      {Refusal::kClock, Settlement::CLOCK},
      {Refusal::kReplaced, Settlement::REPLACED},
      {Refusal::kEmergency, Settlement::EMERGENCY}};
  for (const auto& [refusal, number] : numbers) {
    CommitmentEvent event;
    event.kind = CommitmentEvent::Kind::kWithdrawn;
    event.refusal = refusal;
    EXPECT_EQ(
        settlement_of({event, event.proposal.tag, std::nullopt}, "map", ros::Time(12.0)).refusal,
        number)
        << name_of(refusal);
    EXPECT_EQ(
        settlement_of({event, event.proposal.tag, std::nullopt}, "map", ros::Time(12.0)).result,
        Settlement::REJECTED);
  }
}

}  // namespace
}  // namespace mocha
