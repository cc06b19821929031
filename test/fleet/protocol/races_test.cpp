// Races of the propose / settle protocol over bad networks.
#include <gtest/gtest.h>

#include "fleet/protocol/network.h"

namespace mocha {
namespace {

using Kind = CommitmentEvent::Kind;
using test::Network;

/// Homes of the robots: corners of a square, so that diagonal motions cross in the middle.
const std::vector<Vector2> kHomes = {{-3.0, -3.0}, {3.0, -3.0}, {-3.0, 3.0}, {3.0, 3.0}};

Network fleet(int seed, const Network::Link& link, int robots, double reach_timeout_s = 1.0) {
  Network network(seed, link);
  for (int i = 0; i < robots; ++i) {
    CommitmentOptions options = test::options("ugv" + std::to_string(i + 1));
    options.reach_timeout_s = reach_timeout_s;
    options.priority = (seed / 7) % 2 == 0 ? 0 : (seed + i) % 3;
    network.add(options);
  }
  for (int i = 0; i < robots; ++i) network.brake(i, test::stand(network.now(), kHomes[i]));
  network.run(reach_timeout_s + 0.2);
  return network;
}

/// From where the robot will be then, through the middle, to somewhere.
Motion crossing(Network& network, int i, double start_s) {
  std::uniform_real_distribution<double> coordinate(-3.5, 3.5);
  std::uniform_real_distribution<double> middle(-0.6, 0.6);
  std::uniform_real_distribution<double> speed(0.5, 1.5);
  auto& random = network.random();
  const Vector2 from = network.robot(i).binding().position(start_s);
  return test::drive(
      start_s, {from, {middle(random), middle(random)}, {coordinate(random), coordinate(random)}},
      speed(random));
}

/// One race: every robot proposes once, at about the same time.
Network race(int seed, const Network::Link& link, int robots, double spread_s) {
  Network network = fleet(seed, link, robots);
  std::uniform_real_distribution<double> when(0.0, spread_s);
  std::multimap<double, int> order;
  for (int i = 0; i < robots; ++i) order.emplace(when(network.random()), i);
  const double begin = network.now();
  for (const auto& [time, robot] : order) {
    network.run(begin + time - network.now(), 0.002);
    network.propose(robot, crossing(network, robot, begin + spread_s + 0.6));
  }
  network.run(1.0, 0.002);
  return network;
}

TEST(Races, DelayCheckAloneIsEnoughWhereMessagesAreFaster) {
  Network::Link link;
  link.max_delay_s = 0.055;
  link.heartbeats = false;
  int settled = 0;
  int refused = 0;
  for (int seed = 0; seed < 1500; ++seed) {
    const Network network = race(seed, link, 2 + seed % 2, 0.1);
    EXPECT_EQ(network.broken(), 0) << seed;
    for (int i = 0; i < network.size(); ++i) {
      settled += network.settled(i) - 1;
      refused += static_cast<int>(network.events(i, Kind::kRejected).size());
    }
  }
  EXPECT_GT(settled, 1500);
  EXPECT_GT(refused, 500);
}

TEST(Races, DelayCheckAloneFailsWhereMessagesAreSlower) {
  // Shows that the races are real: without endorsements and with slow messages promises do collide.
  Network::Link link;
  link.min_delay_s = 0.1;
  link.max_delay_s = 0.3;
  link.heartbeats = false;
  int broken = 0;
  for (int seed = 0; seed < 100; ++seed) broken += race(seed, link, 2, 0.1).broken();
  EXPECT_GT(broken, 20);
}

TEST(Races, EndorsementsHoldWhateverTheNetworkDoes) {
  int settled = 0;
  int refused = 0;
  for (int seed = 0; seed < 250; ++seed) {
    Network::Link link;
    link.max_delay_s = 0.05 + 0.01 * (seed % 40);
    link.loss = 0.1 * (seed % 5);
    Network network = fleet(seed, link, 2 + seed % 3, 10.0);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int step = 0; step < 150; ++step) {
      const int robot = static_cast<int>(uniform(network.random()) * network.size());
      const double lead = 0.5 + 3.0 * uniform(network.random());
      if (uniform(network.random()) < 0.25) {
        network.propose(robot, crossing(network, robot, network.now() + lead));
      }
      network.run(0.1, 0.02);
    }
    EXPECT_EQ(network.broken(), 0) << seed;
    for (int i = 0; i < network.size(); ++i) {
      settled += network.settled(i) - 1;
      refused += static_cast<int>(network.events(i, Kind::kRejected).size());
      EXPECT_TRUE(network.events(i, Kind::kBreached).empty()) << seed;
    }
  }
  EXPECT_GT(settled, 1000);
  EXPECT_GT(refused, 1000);
}

TEST(Races, OneRobotAlwaysWins) {
  for (int seed = 0; seed < 1000; ++seed) {
    Network::Link link;
    link.max_delay_s = 0.08;
    const int robots = 2 + seed % 3;
    Network network = race(seed, link, robots, seed % 2 == 0 ? 0.0 : 0.1);
    int winners = 0;
    for (int i = 0; i < robots; ++i) winners += network.settled(i) - 1;
    EXPECT_GE(winners, 1) << seed;
    EXPECT_EQ(network.broken(), 0) << seed;
    for (int i = 0; i < robots; ++i) {  // no robot is left hanging
      EXPECT_EQ(network.robot(i).state(), CommitmentProtocol::State::kBound) << seed;
    }
  }
}

TEST(Races, RankDecidesBetweenProposalsOfTheSameMoment) {
  for (const int favoured : {0, 1}) {
    for (int seed = 0; seed < 50; ++seed) {
      Network::Link link;
      link.min_delay_s = 0.005;
      link.max_delay_s = 0.1;
      Network network(seed, link);
      for (int i = 0; i < 2; ++i) {
        CommitmentOptions options = test::options("ugv" + std::to_string(i + 1));
        options.priority = i == favoured ? 5 : (favoured == 0 ? 5 : 0);  // a tie, or the second
        network.add(options);
      }
      network.run(1.2);
      const double start = network.now() + 0.8;
      network.propose(0, test::drive(start, {{-3.0, 0.0}, {3.0, 0.0}}, 1.0));
      network.propose(1, test::drive(start, {{0.0, -3.0}, {0.0, 3.0}}, 1.0));
      network.run(0.7, 0.005);
      EXPECT_EQ(network.settled(favoured), 1);
      EXPECT_EQ(network.settled(1 - favoured), 0);
      const auto rejected = network.events(1 - favoured, Kind::kRejected);
      ASSERT_EQ(rejected.size(), 1u);
      const Conflict& conflict = rejected[0].conflict;
      EXPECT_EQ(conflict.peer, favoured == 0 ? "ugv1" : "ugv2");
      EXPECT_NEAR(conflict.required_m, 0.8, 1e-9);
      EXPECT_LT(conflict.distance_m, 0.1);  // they would meet in the middle
      EXPECT_GT(conflict.time_s, start);
    }
  }
}

TEST(Races, AFleetThatPlansAnewAtOnceSettlesAsFastAsOneRobot) {
  constexpr int kRobots = 30;
  Network::Link link;
  link.max_delay_s = 0.005;
  Network network(1, link);
  for (int i = 0; i < kRobots; ++i) network.add(test::options("ugv" + std::to_string(i)));
  network.run(1.2);
  const int before = network.heartbeats();
  for (int i = 0; i < kRobots; ++i)
    network.propose(i, test::stand(network.now() + 0.5, {10.0 * i, 0.0}));
  network.run(network.robot(0).options().delta_dc_s + 0.012, 0.002);
  for (int i = 0; i < kRobots; ++i) EXPECT_EQ(network.settled(i), 1) << i;
  EXPECT_LE(network.heartbeats() - before,
            4 * kRobots);  // not one for each of the others' proposals
}

TEST(Races, LateJoinerLearnsWhatIsPromisedBeforeItMayPropose) {
  Network::Link link;
  link.loss = 0.2;
  link.max_delay_s = 0.05;
  Network network(3, link);
  network.add(test::options("ugv1"));
  network.add(test::options("ugv2"));
  network.cut_off(1, true);
  network.run(1.2);
  network.propose(0, test::drive(network.now() + 0.5, {{-3.0, 0.0}, {3.0, 0.0}}, 0.3));
  network.run(1.0);
  ASSERT_EQ(network.settled(0), 1);
  network.cut_off(1, false);
  network.restart(1, test::options("ugv2", 2));
  network.run(0.5);
  EXPECT_EQ(network.robot(1).state(), CommitmentProtocol::State::kListening);
  network.run(0.7);
  ASSERT_EQ(network.robot(1).state(), CommitmentProtocol::State::kIdle);
  ASSERT_EQ(network.robot(1).peers().peers().count("ugv1"), 1u);
  EXPECT_FALSE(network.robot(1).peers().peers().at("ugv1").binding.empty());
  network.propose(1, test::drive(network.now() + 0.5, {{0.0, -1.0}, {0.0, 1.0}}, 0.1));
  const auto rejected = network.events(1, Kind::kRejected);
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0].refusal, Refusal::kPeerPromise);
}

TEST(Races, SilentPeerIsNotWaitedForButItsPromiseHolds) {
  Network network(1, {});
  network.add(test::options("ugv1"));
  network.add(test::options("ugv2"));
  network.run(1.2);
  network.propose(1, test::drive(network.now() + 0.5, {{0.0, -3.0}, {0.0, 0.0}}, 1.0));
  network.run(1.0);
  ASSERT_EQ(network.settled(1), 1);
  network.cut_off(1, true);
  network.run(0.2);
  network.propose(0, test::drive(network.now() + 0.4, {{-5.0, 2.0}, {5.0, 2.0}}, 1.0));
  network.run(0.6);  // the peer still counts as in reach and says nothing
  auto rejected = network.events(0, Kind::kRejected);
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0].refusal, Refusal::kUnanswered);
  EXPECT_EQ(rejected[0].conflict.peer, "ugv2");
  network.run(5.0);  // its motion is over; it stands at (0, 0) as far as the fleet knows
  network.propose(0, test::drive(network.now() + 0.4, {{-5.0, 0.0}, {5.0, 0.0}}, 1.0));
  rejected = network.events(0, Kind::kRejected);
  ASSERT_EQ(rejected.size(), 2u);
  EXPECT_EQ(rejected[1].refusal, Refusal::kPeerPromise);
  network.propose(0, test::drive(network.now() + 0.4, {{-5.0, 2.0}, {5.0, 2.0}}, 1.0));
  network.run(0.2);
  EXPECT_EQ(network.settled(0), 1);
}

TEST(Races, RestartedPeerIsHeardAndItsFormerPromiseStaysUntilItPromisesAnew) {
  Network network(1, {});
  network.add(test::options("ugv1"));
  network.add(test::options("ugv2"));
  network.run(1.2);
  network.propose(1, test::drive(network.now() + 0.5, {{0.0, -3.0}, {0.0, 3.0}}, 1.0));
  network.run(0.3);
  network.restart(1, test::options("ugv2", 2));
  network.run(1.2);
  const Peer& peer = network.robot(0).peers().peers().at("ugv2");
  EXPECT_EQ(peer.epoch, 2u);
  ASSERT_FALSE(peer.binding.empty());
  EXPECT_EQ(peer.binding.newest().id.epoch, 1u);
  network.propose(0, test::drive(network.now() + 0.4, {{-1.0, 3.0}, {0.5, 3.0}}, 1.0));
  const auto rejected = network.events(0, Kind::kRejected);
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0].refusal, Refusal::kPeerPromise);
  // Sequences begin at 1 again; no continuity is asked of the first motion.
  network.propose(1, test::drive(network.now() + 0.4, {{1.0, -4.0}, {3.0, -4.0}}, 1.0));
  network.run(0.6);
  EXPECT_EQ(network.settled(1), 2);
  EXPECT_EQ(peer.binding.newest().id, (TrajectoryId{2, 1}));
  network.propose(0, test::drive(network.now() + 0.4, {{-1.0, 3.0}, {0.5, 3.0}}, 1.0));
  network.run(0.3);
  EXPECT_EQ(network.settled(0), 1);
}

TEST(Races, RobotsThatAreTooCloseMayPart) {
  Network network(1, {});
  network.add(test::options("ugv1"));
  network.add(test::options("ugv2"));
  network.brake(0, test::stand(network.now(), {0.0, 0.0}));
  network.brake(1, test::stand(network.now(), {0.65, 0.0}));
  network.run(1.2);
  network.propose(0, test::drive(network.now() + 0.4, {{0.0, 0.0}, {1.0, 1.0}}, 1.0));
  EXPECT_EQ(network.events(0, Kind::kRejected).size(), 1u);  // closer still
  network.propose(0, test::drive(network.now() + 0.4, {{0.0, 0.0}, {-3.0, 0.0}}, 1.0));
  network.run(0.3);
  EXPECT_EQ(network.settled(0), 2);
}

}  // namespace
}  // namespace mocha
