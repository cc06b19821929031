#include "ros/promise_conversions.h"

#include <gtest/gtest.h>

#include <limits>

#include "fleet/motions.h"

namespace mocha {
namespace {

Promise promise() {
  Promise promise;
  promise.agent = "ugv1";
  promise.id = {4, 17};
  promise.state = PromiseState::kCommitted;
  promise.priority = -2;
  promise.footprint_radius_m = 0.3;
  promise.motion = test::shared(test::drive(12.5, {{0.0, 1.0}, {2.0, 1.5}, {4.0, 0.0}}, 1.0));
  return promise;
}

TEST(PromiseConversions, GoThereAndBack) {
  const auto message = to_message(promise(), "map", ros::Time(12.0));
  const Promise back = promise_from_message(message, "map");
  EXPECT_EQ(back.agent, "ugv1");
  EXPECT_EQ(back.id, (PromiseId{4, 17}));
  EXPECT_EQ(back.state, PromiseState::kCommitted);
  EXPECT_EQ(back.priority, -2);
  EXPECT_DOUBLE_EQ(back.footprint_radius_m, 0.3);
  for (double t = 12.0; t < 18.0; t += 0.1) {
    const Vector2 expected = promise().motion->at(t).pose.position;
    EXPECT_NEAR((back.motion->at(t).pose.position - expected).norm(), 0.0, 1e-9);
  }
  const Beat beat{
      "ugv2", 3, 12.0, {{"ugv1", {4, 17}, PromiseState::kEmergency}}, {{"ugv1", 11.5, 0.25}}};
  const Beat heard = beat_from_message(to_message(beat, "map", ros::Time(12.0)));
  EXPECT_EQ(heard.agent, "ugv2");
  EXPECT_EQ(heard.epoch, 3u);
  ASSERT_EQ(heard.seen.size(), 1u);
  EXPECT_EQ(heard.seen[0].agent, "ugv1");
  EXPECT_EQ(heard.seen[0].id, (PromiseId{4, 17}));
  EXPECT_EQ(heard.seen[0].state, PromiseState::kEmergency);
  EXPECT_EQ(heard.stamp_s, 12.0);
  ASSERT_EQ(heard.echoes.size(), 1u);
  EXPECT_EQ(heard.echoes[0].agent, "ugv1");
  EXPECT_EQ(heard.echoes[0].stamp_s, 11.5);
  EXPECT_EQ(heard.echoes[0].held_s, 0.25);
}

TEST(PromiseConversions, AWithdrawalNeedsNoMotion) {
  Promise withdrawn = promise();
  withdrawn.state = PromiseState::kWithdrawn;
  withdrawn.motion.reset();
  const auto message = to_message(withdrawn, "map", ros::Time(12.0));
  EXPECT_EQ(promise_from_message(message, "map").state, PromiseState::kWithdrawn);
}

TEST(PromiseConversions, RefuseWhatNobodyCanHaveMeant) {
  const auto good = to_message(promise(), "map", ros::Time(12.0));
  const auto refused = [&](auto change) {
    auto message = good;
    change(message);
    EXPECT_THROW(promise_from_message(message, "map"), std::invalid_argument);
  };
  refused([](auto& m) { m.header.frame_id = "odom"; });
  refused([](auto& m) { m.agent.clear(); });
  refused([](auto& m) { m.sequence = 0; });
  refused([](auto& m) { m.state = mocha_ugv::Trajectory::PLANNED; });
  refused([](auto& m) { m.state = 5; });
  refused([](auto& m) { m.footprint_radius = 0.0; });
  refused([](auto& m) { m.footprint_radius = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& m) { m.footprint_radius = 11.0; });
  refused([](auto& m) { m.phases.clear(); });
  refused([](auto& m) { m.phases[0].x[1] = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& m) { m.phases[0].durations[0] = 1e-3; });  // far too fast
  refused([](auto& m) { m.phases[0].durations[0] = 1e9; });
  mocha_ugv::Heartbeat beat;
  EXPECT_THROW(beat_from_message(beat), std::invalid_argument);
  beat.agent = "ugv1";
  beat.seen.resize(1);
  EXPECT_THROW(beat_from_message(beat), std::invalid_argument);
}

TEST(PromiseConversions, SettlementsSayWhatWhereWhenAndByHowMuch) {
  using mocha_ugv::PlannerStatus;
  CommitmentEvent event;
  event.kind = CommitmentEvent::Kind::kRejected;
  event.refusal = Refusal::kPeerPromise;
  event.proposal.tag = 23;
  event.conflict = {"ugv2", 14.25, 0.31, 0.8, {1.5, -2.0}};
  const auto status = settlement_of(event, "map", ros::Time(12.0));
  EXPECT_EQ(status.reason, PlannerStatus::PEER_CONFLICT);
  EXPECT_EQ(status.violated, PlannerStatus::SEPARATION);
  EXPECT_EQ(status.peer, "ugv2");
  EXPECT_DOUBLE_EQ(status.at.toSec(), 14.25);
  EXPECT_DOUBLE_EQ(status.place.x, 1.5);
  EXPECT_DOUBLE_EQ(status.value, 0.31);
  EXPECT_DOUBLE_EQ(status.limit, 0.8);
  for (const char* part :
       {"proposal 23: ", "0.31 m", "ugv2", "0.80 m", "(1.50, -2.00)", "14.25 s"}) {
    EXPECT_NE(status.message.find(part), std::string::npos) << status.message;
  }
  event.refusal = Refusal::kDiscontinuous;
  EXPECT_EQ(settlement_of(event, "map", ros::Time(12.0)).reason, PlannerStatus::INVALID_INPUT);
  event = CommitmentEvent();
  event.proposal.tag = 24;
  EXPECT_EQ(settlement_of(event, "map", ros::Time(12.0)).reason, PlannerStatus::SOLVED);
  EXPECT_EQ(settlement_of(event, "map", ros::Time(12.0)).message, "proposal 24: is binding");
}

}  // namespace
}  // namespace mocha
