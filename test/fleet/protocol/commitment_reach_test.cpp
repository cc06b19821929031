// Who has to agree to a proposal, how far it may lead, and what is said of whom.
#include <gtest/gtest.h>

#include <map>

#include "fleet/protocol/commitment_protocol.h"
#include "fleet/protocol/motions.h"
#include "fleet/protocol/network.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

using State = CommitmentProtocol::State;

constexpr double kStart_s = 10.0;
constexpr double kNow_s = 12.0;

Proposal proposal(Motion motion) {
  return {7, 0.3, test::kRoverBraking, test::shared(std::move(motion))};
}

/// The robot "m" at (-3, 0), which may promise 8 m far, and peers that stand so far from it.
class CommitmentReach : public ::testing::Test {
 protected:
  CommitmentReach() {
    robot_.tick(kStart_s);
    robot_.brake(proposal(test::stand(kNow_s - 0.1, {-3.0, 0.0})), kNow_s - 0.1);
  }

  static CommitmentOptions options() {
    CommitmentOptions options = test::options("m");
    options.reach = {40.0, 2.0, 8.0};
    return options;
  }

  void add_peer(const std::string& name, double distance_m) {
    CommittedTrajectory stands;
    stands.agent = name;
    stands.id = {1, 1};
    stands.state = TrajectoryState::kCommitted;
    stands.footprint_radius_m = 0.3;
    stands.braking = test::kRoverBraking;
    stands.motion = test::shared(test::stand(kNow_s - 0.1, {-3.0 - distance_m, 0.0}));
    robot_.receive(stands, kNow_s);
    say(name, kNow_s);
  }
  CommitmentActions say(const std::string& name, double now) {
    const Acknowledgement own{name, {1, 1}, TrajectoryState::kCommitted};
    return robot_.receive(Heartbeat{name, 1, now, {own}, {{"m", now, 0.0}}, 8.0}, now);
  }

  /// Through 6 m, away from the peers.
  static Motion along_x() { return test::drive(kNow_s + 1.0, {{-3.0, 0.0}, {3.0, 0.0}}, 1.0); }

  CommitmentProtocol robot_{options()};
};

TEST_F(CommitmentReach, OnlyNearPeersHaveToAgree) {
  add_peer("far", 20.0);
  robot_.propose(proposal(along_x()), kNow_s);
  robot_.tick(kNow_s + 0.1);
  EXPECT_EQ(robot_.state(), State::kBound);
  add_peer("near", 10.0);
  robot_.propose(proposal(along_x()), kNow_s + 0.1);
  robot_.tick(kNow_s + 0.3);
  EXPECT_EQ(robot_.state(), State::kRevising);
}

TEST_F(CommitmentReach, PromisesNoFartherThanThat) {
  const Motion far = test::drive(kNow_s + 1.0, {{-3.0, 0.0}, {5.5, 0.0}}, 1.0);
  try {
    robot_.propose(proposal(far), kNow_s);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("leads 8.5"), std::string::npos) << error.what();
  }
  robot_.propose(proposal(along_x()), kNow_s);
  robot_.tick(kNow_s + 0.1);
  EXPECT_EQ(robot_.state(), State::kBound);
  // Together with what is left of the motion in force.
  const Motion back = test::drive(kNow_s + 1.5, {{-3.0, 0.0}, {-6.0, 0.0}}, 1.0);
  EXPECT_THROW(robot_.propose(proposal(back), kNow_s + 0.2), std::invalid_argument);
  EXPECT_NO_THROW(robot_.brake(proposal(back), kNow_s + 0.2));  // a stop is said in any case
}

TEST_F(CommitmentReach, AHeartbeatDoesNotGrowWithTheFleet) {
  constexpr int kPeers = 200;
  const auto name = [](int i) { return "p" + std::to_string(i); };
  for (int i = 0; i < kPeers; ++i) add_peer(name(i), 1.0 + i);
  std::map<std::string, int> acknowledged;
  std::map<std::string, int> echoed;
  const auto count = [&](const CommitmentActions& actions) {
    if (!actions.heartbeat) return;
    EXPECT_LE(actions.heartbeat->acknowledgements.size(),
              HeartbeatLines::kMostAcknowledged + 1);  // and its own promise
    EXPECT_LE(actions.heartbeat->echoes.size(), HeartbeatLines::kMostEchoed);
    for (const Acknowledgement& line : actions.heartbeat->acknowledgements)
      ++acknowledged[line.agent];
    for (const Echo& line : actions.heartbeat->echoes) ++echoed[line.agent];
  };
  count(robot_.tick(kNow_s + 0.1));  // with what is endorsed of those that came
  for (double t = kNow_s + 0.2; t < kNow_s + 60.0; t += 0.1) {
    for (int i = 0; i < kPeers; ++i) count(say(name(i), t));
  }
  for (int i = 0; i < kPeers; ++i) {
    EXPECT_GE(acknowledged[name(i)], i < 10 ? 150 : 2) << i;
    EXPECT_GE(echoed[name(i)], i < 10 ? 75 : 1) << i;
  }
  EXPECT_GT(acknowledged[name(3)], 10 * acknowledged[name(190)]);
}

}  // namespace
}  // namespace mocha
