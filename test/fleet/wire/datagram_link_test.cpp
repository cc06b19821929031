#include "fleet/wire/datagram_link.h"

#include <gtest/gtest.h>

#include <random>

#include "fleet/protocol/motions.h"
#include "fleet/protocol/peer_table.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
const FleetKey kKey(FleetKey::Secret{1, 2, 3});
const FleetKey kOtherKey(FleetKey::Secret{1, 2, 4});

Heartbeat heartbeat_of(const std::string& agent, std::uint32_t epoch = 1) {
  return {agent, epoch, kNow_s, {}, {}};
}

std::optional<FleetMessage> unpacked(DatagramLink& link, const DatagramLink::Bytes& bytes) {
  return link.unpack(bytes.data(), bytes.size());
}

TEST(DatagramLink, CarriesMessagesOfOthersOnce) {
  for (const bool keyed : {false, true}) {
    const auto key = keyed ? std::optional<FleetKey>(kKey) : std::nullopt;
    DatagramLink a("a", key);
    DatagramLink b("b", key);
    const auto bytes = a.pack(heartbeat_of("a")).at(0);
    const auto message = unpacked(b, bytes);
    ASSERT_TRUE(message);
    EXPECT_EQ(std::get<Heartbeat>(*message).agent, "a");
    EXPECT_FALSE(unpacked(b, bytes));  // recorded, and played again
    EXPECT_TRUE(unpacked(b, a.pack(heartbeat_of("a")).at(0)));
    EXPECT_EQ(b.counts().taken, 2);
    EXPECT_EQ(b.counts().repeated, 1);
    EXPECT_EQ(b.counts().refused(), 0);
    EXPECT_EQ(b.loss("a"), 0.0);
    EXPECT_FALSE(b.loss("c"));
  }
}

TEST(DatagramLink, WhatIsSaidAboutPassingIsOfTheOneThatSaysIt) {
  DatagramLink a("a", kKey);
  DatagramLink b("b", kKey);
  const PassingIntent intent{"a", 1, 0, true, 0.3, Vector2(1.0, 2.0), {"c", 4, 5}, 6};
  PassingInstruction instruction;
  instruction.id = {"a", 1, 2};
  instruction.robots = {"a", "b"};
  instruction.robot = "b";
  for (const FleetMessage& message : {FleetMessage(intent), FleetMessage(instruction)}) {
    const auto bytes = a.pack(message).at(0);
    EXPECT_FALSE(unpacked(a, bytes));
    const auto heard = unpacked(b, bytes);
    ASSERT_TRUE(heard);
    EXPECT_EQ(heard->index(), message.index());
  }
  EXPECT_EQ(a.counts().own, 2);
  EXPECT_EQ(b.counts().taken, 2);
  EXPECT_EQ(b.loss("a"), 0.0);
}

TEST(DatagramLink, ARecordingOfAFormerStartIsOver) {
  DatagramLink before("a", kKey);
  DatagramLink after("a", kKey);
  DatagramLink b("b", kKey);
  CommittedTrajectory stands{
      "a", {1, 1}, TrajectoryState::kCommitted, 0, 0.3, test::kRoverBraking, nullptr};
  stands.motion = test::shared(test::stand(kNow_s, {1.0, 2.0}));
  const auto old = before.pack(stands).at(0);
  EXPECT_TRUE(unpacked(b, after.pack(heartbeat_of("a", 2)).at(0)));
  EXPECT_FALSE(unpacked(b, old));
  EXPECT_EQ(b.counts().repeated, 1);
}

/// Over the network, too, as where its epoch file is gone.
TEST(DatagramLink, ARobotThatLostTheCountOfItsStartsIsToldByItsPeers) {
  DatagramLink before("a", kKey);
  DatagramLink after("a", kKey);
  DatagramLink link("b", kKey);
  PeerTable b("b", 1, 1.0, {0.0, 0.25});
  PeerTable a("a", 1, 1.0, {0.0, 0.25});
  const auto hear = [&](const std::optional<FleetMessage>& heard) {
    ASSERT_TRUE(heard);
    b.receive(std::get<Heartbeat>(*heard), kNow_s);
  };
  hear(unpacked(link, before.pack(heartbeat_of("a", 7)).at(0)));
  hear(unpacked(link, after.pack(heartbeat_of("a", 1)).at(0)));
  EXPECT_EQ(b.peers().at("a").epoch, 7u);
  EXPECT_EQ(b.old_messages(), 1);
  Heartbeat answer = heartbeat_of("b");
  answer.acknowledgements = {*b.acknowledgement("a", kNow_s + 0.1)};
  const auto told = unpacked(after, link.pack(answer).at(0));
  ASSERT_TRUE(told);
  a.receive(std::get<Heartbeat>(*told), kNow_s + 0.2);
  EXPECT_EQ(a.known_epoch(), 7u);
}

TEST(DatagramLink, TellsItselfFromOneThatBearsItsName) {
  DatagramLink a("a", std::nullopt);
  DatagramLink other("a", std::nullopt);
  EXPECT_FALSE(unpacked(a, a.pack(heartbeat_of("a")).at(0)));
  EXPECT_EQ(a.counts().own, 1);
  EXPECT_FALSE(unpacked(a, other.pack(heartbeat_of("a", 7)).at(0)));
  EXPECT_EQ(a.counts().impostors, 1);
  EXPECT_NE(a.last_refusal().find("called a"), std::string::npos);
}

TEST(DatagramLink, StrangersAreIgnoredAndTheReasonIsCounted) {
  DatagramLink keyed("a", kKey);
  DatagramLink open("b", std::nullopt);
  DatagramLink other("c", kOtherKey);
  EXPECT_FALSE(unpacked(keyed, open.pack(heartbeat_of("b")).at(0)));
  EXPECT_EQ(keyed.counts().unsealed, 1);
  EXPECT_FALSE(unpacked(keyed, other.pack(heartbeat_of("c")).at(0)));
  EXPECT_EQ(keyed.counts().foreign, 1);
  EXPECT_FALSE(unpacked(open, keyed.pack(heartbeat_of("a")).at(0)));
  EXPECT_EQ(open.counts().foreign, 1);
  EXPECT_NE(open.last_refusal().find("no fleet key"), std::string::npos);
  EXPECT_EQ(keyed.counts().refused(), 2);
}

TEST(DatagramLink, KnowsTheLossOfEachSender) {
  DatagramLink a("a", std::nullopt);
  DatagramLink b("b", std::nullopt);
  for (int i = 0; i < 200; ++i) {
    const auto bytes = a.pack(heartbeat_of("a")).at(0);
    if (i % 5 != 0) unpacked(b, bytes);
  }
  EXPECT_NEAR(b.loss("a").value(), 0.2, 0.03);
}

TEST(DatagramLink, InventedNamesTakeNoMoreMemoryThanAFleet) {
  DatagramLink b("b", std::nullopt);
  constexpr int kInvented = static_cast<int>(DatagramLink::kMostSenders) + 150;
  for (int i = 0; i < kInvented; ++i) {
    const std::string name = "invented" + std::to_string(i);
    DatagramLink stranger(name, std::nullopt);
    unpacked(b, stranger.pack(heartbeat_of(name)).at(0));
  }
  EXPECT_EQ(b.counts().taken, static_cast<int>(DatagramLink::kMostSenders));
  EXPECT_EQ(b.counts().crowded_out, 150);
}

TEST(DatagramLink, WhatCannotBeSentTakesNoNumber) {
  DatagramLink a("a", std::nullopt);
  DatagramLink b("b", std::nullopt);
  CommittedTrajectory trajectory{
      "a", {1, 1}, TrajectoryState::kProposed, 0, 0.3, test::kRoverBraking, nullptr};
  trajectory.motion = test::shared(test::drive(kNow_s, {{0.0, 0.0}, {3e4, 0.0}}, 20.0));
  EXPECT_THROW(a.pack(trajectory), std::invalid_argument);
  unpacked(b, a.pack(heartbeat_of("a")).at(0));
  unpacked(b, a.pack(heartbeat_of("a")).at(0));
  EXPECT_EQ(b.loss("a"), 0.0);
}

}  // namespace
}  // namespace mocha
