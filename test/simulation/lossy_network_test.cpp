#include "simulation/lossy_network.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mocha {
namespace {

using Network = LossyNetwork<int>;

/// Of `count` messages from member 0 to member 1, sent 1 ms apart from time 0 on.
std::vector<Network::Delivery> arrivals(Network network, int count) {
  for (int i = 0; i < count; ++i) network.send(0, 1, i, 0.001 * i);
  return network.receive(1e9);
}

TEST(LossyNetwork, DelaysWithinItsBoundsAndSoReorders) {
  const auto arrived = arrivals(Network(1, {0.02, 0.1, 0.0}), 1000);
  ASSERT_EQ(arrived.size(), 1000u);
  double longest_s = 0.0;
  double shortest_s = 1.0;
  int overtaken = 0;
  for (std::size_t i = 0; i < arrived.size(); ++i) {
    const double delay_s = arrived[i].due_s - 0.001 * arrived[i].message;
    longest_s = std::max(longest_s, delay_s);
    shortest_s = std::min(shortest_s, delay_s);
    if (i == 0) continue;
    EXPECT_LE(arrived[i - 1].due_s, arrived[i].due_s);
    overtaken += arrived[i].message < arrived[i - 1].message;
  }
  EXPECT_NEAR(shortest_s, 0.02, 0.002);
  EXPECT_NEAR(longest_s, 0.1, 0.002);
  EXPECT_GT(overtaken, 100);
}

TEST(LossyNetwork, LosesItsShare) {
  EXPECT_NEAR(static_cast<double>(arrivals(Network(2, {0.0, 0.0, 0.3}), 10000).size()), 7000.0,
              150.0);
  EXPECT_TRUE(arrivals(Network(2, {0.0, 0.0, 1.0}), 100).empty());
}

TEST(LossyNetwork, IsTheSameForTheSameSeed) {
  const NetworkLink link{0.0, 0.1, 0.2};
  const auto same = [](const Network::Delivery& a, const Network::Delivery& b) {
    return a.due_s == b.due_s && a.message == b.message;
  };
  const auto first = arrivals(Network(3, link), 200);
  const auto again = arrivals(Network(3, link), 200);
  const auto other = arrivals(Network(4, link), 200);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), again.begin(), again.end(), same));
  EXPECT_FALSE(std::equal(first.begin(), first.end(), other.begin(), other.end(), same));
}

TEST(LossyNetwork, DeliversNothingBeforeItsTimeAndNothingTwice) {
  Network network(5, {0.1, 0.1, 0.0});
  network.send(0, 1, 7, 10.0);
  EXPECT_TRUE(network.receive(10.09).empty());
  EXPECT_EQ(network.receive(10.11).size(), 1u);
  EXPECT_TRUE(network.receive(20.0).empty());
}

TEST(LossyNetwork, BroadcastsToAllOthers) {
  Network network(6, {});
  network.broadcast(1, 4, 7, 0.0);
  std::vector<int> receivers;
  for (const auto& delivery : network.receive(1.0)) {
    EXPECT_EQ(delivery.from, 1);
    receivers.push_back(delivery.to);
  }
  std::sort(receivers.begin(), receivers.end());
  EXPECT_EQ(receivers, (std::vector<int>{0, 2, 3}));
}

TEST(LossyNetwork, AMemberThatIsCutOffNeitherSendsNorReceives) {
  Network network(7, {});
  network.send(0, 1, 1, 0.0);
  network.cut_off(1, true);
  network.send(1, 0, 2, 0.0);
  EXPECT_TRUE(network.receive(1.0).empty());
  network.cut_off(1, false);
  network.send(0, 1, 3, 1.0);
  EXPECT_EQ(network.receive(2.0).size(), 1u);
}

TEST(LossyNetwork, RefusesLinksThatCannotBe) {
  EXPECT_THROW(Network(1, {-0.1, 0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(Network(1, {0.2, 0.1, 0.0}), std::invalid_argument);
  EXPECT_THROW(Network(1, {0.0, 0.1, 1.5}), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
