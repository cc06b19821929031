#include "fleet/protocol/emergency_stop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

#include "fleet/wire/datagram_link.h"
#include "simulation/lossy_network.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.02;

/// Robots that hear each other's stops over a network.
class Fleet {
 public:
  Fleet(int robots, const NetworkLink& link, int seed = 1) : network_(seed, link) {
    for (int i = 0; i < robots; ++i) join();
  }

  void join(StopRecord record = {}) {
    const std::string name = "ugv" + std::to_string(robots_.size() + 1);
    robots_.push_back(std::make_unique<EmergencyStop>(name, 1, std::move(record)));
  }
  void restart(int i, StopRecord record) {
    robots_[i] = std::make_unique<EmergencyStop>("ugv" + std::to_string(i + 1), 2, record);
  }
  EmergencyStop& robot(int i) { return *robots_[i]; }
  void cut_off(int i, bool off) { network_.cut_off(i, off); }
  double now() const { return now_; }

  void run(double seconds) {
    for (const double until = now_ + seconds; now_ < until;) {
      now_ += kStep_s;
      for (const auto& delivery : network_.receive(now_))
        robots_[delivery.to]->receive(delivery.message, now_);
      const int robots = static_cast<int>(robots_.size());
      for (int i = 0; i < robots; ++i) {
        for (const FleetStops& message : robots_[i]->tick(now_)) {
          heard_.push_back(message);
          network_.broadcast(i, robots, message, now_);
        }
      }
    }
  }

  int stopped() const {
    return static_cast<int>(
        std::count_if(robots_.begin(), robots_.end(), [](const auto& r) { return r->stopped(); }));
  }
  /// All that was ever said.
  const std::vector<FleetStops>& heard() const { return heard_; }

 private:
  LossyNetwork<FleetStops> network_;
  std::vector<std::unique_ptr<EmergencyStop>> robots_;
  std::vector<FleetStops> heard_;
  double now_ = 100.0;
};

FleetStops said(const std::string& by, std::vector<FleetStop> stops) {
  return {by, 1, std::move(stops)};
}

TEST(EmergencyStop, OfARobotIsItsOwnAndLatched) {
  Fleet fleet(2, {});
  fleet.robot(0).stop_robot(fleet.now(), "button");
  fleet.robot(0).stop_robot(fleet.now() + 5.0, "another button");
  fleet.run(3.0);
  EXPECT_TRUE(fleet.robot(0).stopped());
  EXPECT_FALSE(fleet.robot(1).stopped());
  EXPECT_EQ(fleet.robot(0).record().reason, "button");
  EXPECT_EQ(fleet.robot(0).record().since_s, 100.0);
  fleet.robot(0).reset_fleet(fleet.now());
  EXPECT_TRUE(fleet.robot(0).stopped()) << "by a reset of the fleet's stops";
  fleet.robot(0).reset_robot();
  EXPECT_FALSE(fleet.robot(0).stopped());
}

TEST(EmergencyStop, OfTheFleetReachesAllAtOnceAndIsResetByAny) {
  Fleet fleet(5, {0.0, 0.01, 0.0});
  fleet.run(2.0);
  fleet.robot(3).stop_fleet(fleet.now(), "button");
  fleet.run(2.0 * kStep_s + 0.01);
  EXPECT_EQ(fleet.stopped(), 5);
  ASSERT_EQ(fleet.robot(0).holding().size(), 1U);
  EXPECT_EQ(fleet.robot(0).holding()[0].agent, "ugv4");
  EXPECT_EQ(fleet.robot(0).holding()[0].reason, "button");
  fleet.robot(1).reset_robot();
  EXPECT_TRUE(fleet.robot(1).stopped()) << "by a reset of its own stop";
  fleet.robot(1).reset_fleet(fleet.now());
  fleet.run(0.1);
  EXPECT_EQ(fleet.stopped(), 0);
  EXPECT_EQ(fleet.robot(0).record().resets, 1U);
}

TEST(EmergencyStop, GetsThroughANetworkThatLosesHalfOfIt) {
  for (int seed = 0; seed < 20; ++seed) {
    Fleet fleet(4, {0.0, 0.05, 0.5}, seed);
    fleet.run(0.5);
    for (int round = 0; round < 5; ++round) {
      fleet.robot(round % 4).stop_fleet(fleet.now(), "");
      fleet.run(0.7);
      EXPECT_EQ(fleet.stopped(), 4) << "seed " << seed << " round " << round;
      fleet.robot((round + 1) % 4).reset_fleet(fleet.now());
      fleet.run(4.0);
      EXPECT_EQ(fleet.stopped(), 0) << "seed " << seed << " round " << round;
    }
  }
}

TEST(EmergencyStop, ARobotThatJoinsLateOrWasCutOffLearnsIt) {
  Fleet fleet(3, {});
  fleet.cut_off(2, true);
  fleet.robot(0).stop_fleet(fleet.now(), "");
  fleet.run(3.0);
  EXPECT_FALSE(fleet.robot(2).stopped());
  fleet.cut_off(2, false);
  fleet.cut_off(0, true);  // from the other one
  fleet.run(1.1);
  EXPECT_TRUE(fleet.robot(2).stopped());
  fleet.run(2.0);
  fleet.join();
  fleet.run(0.2);  // it is answered; the next repetition may be a second away
  EXPECT_TRUE(fleet.robot(3).stopped());
}

TEST(EmergencyStop, AnOldVersionIsAnswered) {
  EmergencyStop robot("ugv1", 1, {});
  robot.stop_fleet(0.0, "");
  double t = 0.0;
  for (; t < 1.5; t += kStep_s) robot.tick(t);
  robot.reset_fleet(t);
  for (const double until = t + 1.2; t < until; t += kStep_s) robot.tick(t);
  while (robot.tick(t).empty()) t += kStep_s;
  EXPECT_TRUE(robot.tick(t + 0.2).empty());
  robot.receive(said("ugv2", {{"ugv1", 1, 0, 0.0, ""}}), t + 0.2);
  const auto answer = robot.tick(t + 0.2);
  ASSERT_EQ(answer.size(), 1U);
  EXPECT_EQ(answer[0].stops.at(0).released, 1U);
  EXPECT_FALSE(robot.stopped());
  robot.receive(said("ugv2", {{"ugv1", 1, 1, 0.0, ""}}), t + 0.5);
  EXPECT_TRUE(robot.tick(t + 0.5).empty()) << "a robot that knows as much needs no answer";
  robot.receive(said("ugv3", {}), t + 0.5);
  EXPECT_FALSE(robot.tick(t + 0.5).empty()) << "a robot that knows nothing does";
}

TEST(EmergencyStop, AResetReleasesOnlyWhatItKnewOf) {
  Fleet fleet(3, {});
  fleet.robot(0).stop_fleet(fleet.now(), "");
  fleet.run(0.5);
  fleet.cut_off(2, true);
  fleet.run(0.5);
  fleet.robot(2).stop_fleet(fleet.now(), "out of reach");
  for (int i = 0; i < 5; ++i) {  // resets as many as there may be
    fleet.robot(1).reset_fleet(fleet.now());
    fleet.robot(0).stop_fleet(fleet.now(), "");
    fleet.run(0.5);
  }
  fleet.robot(1).reset_fleet(fleet.now());
  fleet.run(0.5);
  EXPECT_EQ(fleet.stopped(), 1);
  fleet.cut_off(2, false);
  fleet.run(2.0);
  EXPECT_EQ(fleet.stopped(), 3) << "the stop of the one out of reach was not reset";
  fleet.robot(1).reset_fleet(fleet.now());
  fleet.run(2.0);
  EXPECT_EQ(fleet.stopped(), 0);
}

TEST(EmergencyStop, AStopAtTheTimeOfAResetHolds) {
  Fleet fleet(2, {});
  fleet.robot(0).stop_fleet(fleet.now(), "");
  fleet.run(1.0);
  fleet.robot(0).reset_fleet(fleet.now());
  fleet.robot(1).stop_fleet(fleet.now(), "");
  fleet.run(2.0);
  EXPECT_EQ(fleet.stopped(), 2);
  EXPECT_EQ(fleet.robot(0).holding().size(), 1U);
}

TEST(EmergencyStop, RecordingsPlayedAgainReleaseNothing) {
  Fleet fleet(3, {});
  for (int i = 0; i < 3; ++i) {
    fleet.robot(i).stop_fleet(fleet.now(), "");
    fleet.run(1.5);
    fleet.robot((i + 1) % 3).reset_fleet(fleet.now());
    fleet.run(1.5);
  }
  const std::vector<FleetStops> recorded = fleet.heard();
  fleet.robot(0).stop_fleet(fleet.now(), "");
  fleet.run(1.5);
  ASSERT_EQ(fleet.stopped(), 3);
  for (const FleetStops& message : recorded) {
    fleet.robot(1).receive(message, fleet.now());
    ASSERT_TRUE(fleet.robot(1).stopped());
  }
}

TEST(EmergencyStop, OfEachNumberTheLargerOneCounts) {
  EmergencyStop robot("ugv1", 1, {});
  robot.receive(said("ugv3", {{"ugv2", 5, 5, 0.0, ""}}), 0.0);
  robot.receive(said("ugv3", {{"ugv2", 6, 4, 0.0, ""}}), 0.0);
  EXPECT_EQ(robot.record().fleet.at("ugv2").ordered, 6U);
  EXPECT_EQ(robot.record().fleet.at("ugv2").released, 5U);
}

TEST(EmergencyStop, AllOrdersOfMessagesLeadToTheSame) {
  Fleet fleet(4, {0.0, 0.3, 0.3});
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i) {
    EmergencyStop& robot = fleet.robot(static_cast<int>(random() % 4));
    if (random() % 2 == 0) {
      robot.stop_fleet(fleet.now(), std::to_string(i));
    } else {
      robot.reset_fleet(fleet.now());
    }
    fleet.run(0.1);
  }
  std::vector<FleetStops> messages = fleet.heard();
  for (int i = 0; i < 20; ++i) {
    std::shuffle(messages.begin(), messages.end(), random);
    EmergencyStop listener("listener", 1, {});
    for (const FleetStops& message : messages) {
      const auto before = listener.record().fleet;
      listener.receive(message, 0.0);
      for (const auto& [agent, stop] : before) {
        EXPECT_GE(listener.record().fleet.at(agent).ordered, stop.ordered);
        EXPECT_GE(listener.record().fleet.at(agent).released, stop.released);
      }
    }
    fleet.run(3.0);
    for (const auto& [agent, stop] : fleet.robot(0).record().fleet) {
      EXPECT_EQ(listener.record().fleet.at(agent).ordered, stop.ordered);
      EXPECT_EQ(listener.record().fleet.at(agent).released, stop.released);
      EXPECT_EQ(listener.record().fleet.at(agent).reason, stop.reason);
    }
  }
}

TEST(EmergencyStop, SurvivesARestartWithItsRecord) {
  Fleet fleet(2, {});
  fleet.robot(0).stop_fleet(fleet.now(), "button");
  fleet.robot(0).stop_robot(fleet.now(), "other button");
  fleet.cut_off(1, true);
  fleet.restart(0, fleet.robot(0).record());
  fleet.run(1.0);
  EXPECT_TRUE(fleet.robot(0).fleet_stopped());
  fleet.robot(0).reset_fleet(fleet.now());
  EXPECT_TRUE(fleet.robot(0).stopped());
}

TEST(EmergencyStop, ARobotThatLostItsRecordLearnsItsOrdersFromTheOthers) {
  Fleet fleet(3, {});
  fleet.robot(0).stop_fleet(fleet.now(), "");
  fleet.run(1.0);
  fleet.restart(0, {});
  fleet.run(1.0);
  EXPECT_TRUE(fleet.robot(0).stopped());
  fleet.robot(1).reset_fleet(fleet.now());
  fleet.run(1.0);
  ASSERT_EQ(fleet.stopped(), 0);
  // Now it orders a stop before it hears that there was one of the same number, released.
  fleet.restart(0, {});
  fleet.robot(0).stop_fleet(fleet.now(), "anew");
  fleet.run(1.0);
  EXPECT_EQ(fleet.stopped(), 3);
  fleet.robot(2).reset_fleet(fleet.now());
  fleet.run(1.0);
  EXPECT_EQ(fleet.stopped(), 0);
}

TEST(EmergencyStop, TheNumbersCannotBeBroughtToTheirEnd) {
  constexpr auto kHighest = std::numeric_limits<std::uint64_t>::max();
  EmergencyStop robot("ugv1", 1, {});
  for (const char* of : {"ugv1", "ugv2"}) {
    robot.receive(said("stranger", {{of, kHighest, kHighest, 0.0, ""}}), 0.0);
    robot.receive(said("stranger", {{of, kHighest, 0, 0.0, ""}}), 0.0);
    robot.receive(said("stranger", {{of, EmergencyStop::kMostNews + 1, 0, 0.0, ""}}), 0.0);
  }
  EXPECT_EQ(robot.refused(), 6);
  EXPECT_FALSE(robot.stopped());
  robot.stop_fleet(1.0, "");
  EXPECT_TRUE(robot.stopped());
  robot.receive(said("ugv2", {{"ugv2", EmergencyStop::kMostNews, 0, 0.0, ""}}), 0.0);
  EXPECT_EQ(robot.holding().size(), 2U);
}

TEST(EmergencyStop, AReleaseInAdvanceDoesNotSilenceARobot) {
  Fleet fleet(2, {});
  for (int i = 0; i < 2; ++i)
    fleet.robot(i).receive(said("stranger", {{"ugv1", 500, 500, 0.0, ""}}), fleet.now());
  fleet.restart(0, {});
  fleet.robot(0).stop_fleet(fleet.now(), "");
  fleet.run(1.0);
  EXPECT_EQ(fleet.stopped(), 2);
}

TEST(EmergencyStop, InventedNamesTakeNoMoreMemoryAndNoStopItsPlace) {
  EmergencyStop robot("zebra", 1, {});
  for (int i = 0; i < 1000; ++i)
    robot.receive(said("stranger", {{"x" + std::to_string(i), 1, 1, 0.0, ""}}), 0.0);
  EXPECT_LE(robot.record().fleet.size(), EmergencyStop::kMostAgents);
  robot.receive(said("ugv2", {{"ugv2", 1, 0, 0.0, ""}}), 0.0);
  EXPECT_TRUE(robot.fleet_stopped());
  for (int i = 0; i < 1000; ++i)
    robot.receive(said("stranger", {{"y" + std::to_string(i), 1, 0, 0.0, ""}}), 0.0);
  EXPECT_EQ(robot.record().fleet.size(), EmergencyStop::kMostAgents);
  EXPECT_EQ(robot.record().fleet.count("ugv2"), 1U);
  robot.stop_fleet(0.0, "");
  EXPECT_EQ(robot.record().fleet.count("zebra"), 1U);
}

TEST(EmergencyStop, IsSaidInMessagesThatFitIntoDatagrams) {
  EmergencyStop robot("ugv1", 1, {});
  for (int i = 10; i < 31; ++i) {
    const std::string name = std::string(61, 'x') + std::to_string(i);
    robot.receive(said(name, {{name, 1, 0, 1.7e9, std::string(kMostReason, 'y')}}), 0.0);
  }
  std::size_t stops = 0;
  for (const FleetStops& message : robot.tick(1.0)) {
    EXPECT_NO_THROW(validate(message));
    EXPECT_LE(encode({1, message}).size(), kMostDatagramBytes);
    stops += message.stops.size();
  }
  EXPECT_EQ(stops, 21U);
}

TEST(EmergencyStop, RefusesWhatNoRobotCanHaveMeant) {
  const FleetStop sound{"ugv1", 5, 4, 1.0, "button"};
  EXPECT_NO_THROW(validate(said("ugv1", {sound})));
  EXPECT_NO_THROW(validate(said("ugv1", {})));
  const auto refused = [&](auto change) {
    FleetStop stop = sound;
    change(stop);
    EXPECT_THROW(validate(said("ugv1", {stop})), std::invalid_argument);
  };
  refused([](FleetStop& stop) { stop.agent.clear(); });
  refused([](FleetStop& stop) { stop.released = 6; });
  refused([](FleetStop& stop) { stop.since_s = std::nan(""); });
  refused([](FleetStop& stop) { stop.reason = std::string(kMostReason + 1, 'x'); });
  refused([](FleetStop& stop) { stop.reason = "two\nlines"; });
  EXPECT_THROW(validate(said("", {sound})), std::invalid_argument);
  EXPECT_THROW(validate(said("ugv1", std::vector<FleetStop>(9, sound))), std::invalid_argument);
}

TEST(EmergencyStop, SealedAndRecordedResetsReleaseNothing) {
  const FleetKey key(FleetKey::Secret{7});
  DatagramLink sender("ugv1", key);
  DatagramLink receiver("ugv2", key);
  EmergencyStop first("ugv1", 1, {});
  EmergencyStop second("ugv2", 1, {});
  const auto hear = [&](const DatagramLink::Bytes& bytes) {
    const auto message = receiver.unpack(bytes.data(), bytes.size());
    if (message) second.receive(std::get<FleetStops>(*message), 0.0);
    return message.has_value();
  };
  first.stop_fleet(0.0, "");
  for (const auto& bytes : sender.pack(first.tick(0.0).at(0))) EXPECT_TRUE(hear(bytes));
  first.reset_fleet(1.0);
  const auto reset = sender.pack(first.tick(1.0).at(0)).at(0);
  EXPECT_TRUE(hear(reset));
  EXPECT_FALSE(second.stopped());
  first.stop_fleet(2.0, "");
  for (const auto& bytes : sender.pack(first.tick(2.0).at(0))) EXPECT_TRUE(hear(bytes));
  EXPECT_FALSE(hear(reset)) << "it has come before";
  EXPECT_TRUE(second.stopped());
  // A sender without the key, or a receiver that was started again and knows no numbers.
  DatagramLink stranger("ugv3", std::nullopt);
  EXPECT_FALSE(hear(stranger.pack(said("ugv3", {{"ugv1", 2, 2, 0.0, ""}})).at(0)));
  receiver = DatagramLink("ugv2", key);
  EXPECT_TRUE(hear(reset));
  EXPECT_TRUE(second.stopped());
}

}  // namespace
}  // namespace mocha
