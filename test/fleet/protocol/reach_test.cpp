#include "fleet/protocol/reach.h"

#include <gtest/gtest.h>

#include <limits>

#include "fleet/protocol/network.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

Reach reach(double radio_range_m, double fleet_speed, double horizon_s) {
  YAML::Node fleet;
  fleet["radio_range"] = radio_range_m;
  fleet["fleet_speed"] = fleet_speed;
  ParameterTable values = ParameterTable::from_schema("config/trajectory_broadcaster.yaml");
  values.assign(fleet, "test");
  return Reach::from(values, load_robot_model("config", "rover"), horizon_s);
}

TEST(Reach, PromisesAreAsLongAsTheHorizonAsks) {
  const Reach wide = reach(100.0, 2.0, 4.0);
  EXPECT_GT(wide.promise_m, 4.5);  // 4 s at 1 m/s, and braking
  EXPECT_LT(wide.promise_m, 8.0);
  EXPECT_EQ(reach(1000.0, 2.0, 4.0).promise_m, wide.promise_m);
  EXPECT_EQ(wide.radio_range_m, 100.0);
  EXPECT_EQ(wide.fleet_speed, 2.0);
}

TEST(Reach, TwoRobotsAreHeardForATimeoutBeforeTheirPromisesCanMeet) {
  const Reach narrow = reach(20.0, 2.0, 60.0);
  const RobotModel robot = load_robot_model("config", "rover");
  const double apart_m = 0.6 + robot.peer_clearance_m + MarginBudget::of(robot).peer_margin_m();
  EXPECT_NEAR(2.0 * narrow.promise_m, 20.0 - apart_m - 2.0 * 2.0 * 1.0, 1e-9);
  EXPECT_LT(reach(20.0, 3.0, 60.0).promise_m, narrow.promise_m - 0.9);
}

TEST(Reach, RefusesWhatLeavesNoRoomToStopAndARobotFasterThanItsFleet) {
  EXPECT_THROW(reach(8.0, 2.0, 4.0), std::invalid_argument);
  EXPECT_THROW(reach(30.0, 0.9, 4.0), std::invalid_argument);
}

/// Robots that roam about a place of 40 m and hear each other over `range_m`; each proposes again
/// and again to drive somewhere, as far as it may.
class Roaming {
 public:
  Roaming(int seed, double range_m, const Reach& reach) : network_(seed, link(), range_m) {
    for (int i = 0; i < kRobots; ++i) {
      CommitmentOptions options = test::options("ugv" + std::to_string(i + 1));
      options.reach = reach;
      network_.add(options);
      network_.brake(i, test::stand(network_.now(), {20.0 * (i % 2), 20.0 * (i / 2)}));
    }
    network_.run(1.2);
  }

  void roam(double time_s) {
    for (const double until = network_.now() + time_s; network_.now() < until;) {
      for (int i = 0; i < kRobots; ++i) propose(i);
      network_.run(0.4);
    }
  }

  int broken() const { return network_.broken(); }
  int settled() const {
    int settled = 0;
    for (int i = 0; i < kRobots; ++i) settled += network_.settled(i);
    return settled;
  }

 private:
  static constexpr int kRobots = 4;
  static constexpr double kSpeed = 1.2;  // on average; at most 2 m/s

  static test::Network::Link link() {
    test::Network::Link link;
    link.max_delay_s = 0.05;
    link.loss = 0.2;
    return link;
  }

  void propose(int i) {
    std::uniform_real_distribution<double> coordinate(-5.0, 25.0);
    auto& random = network_.random();
    const CommitmentProtocol& robot = network_.robot(i);
    const double start_s = network_.now() + 0.35;
    const Vector2 from = robot.binding().position(start_s);
    const Vector2 way = Vector2(coordinate(random), coordinate(random)) - from;
    const double most_m = std::min(way.norm(), 0.9 * robot.options().reach.promise_m);
    if (most_m < 1.0) return;
    try {
      network_.propose(i, test::drive(start_s, {from, from + most_m * way.normalized()}, kSpeed));
    } catch (const std::invalid_argument&) {  // together with what is driven, too far
    }
  }

  test::Network network_;
};

TEST(Reach, NobodyIsMetUnheard) {
  constexpr double kRange_m = 16.0;
  int settled = 0;
  for (int seed = 0; seed < 12; ++seed) {
    Roaming fleet(seed, kRange_m, reach(kRange_m, 2.0, 60.0));
    fleet.roam(40.0);
    EXPECT_EQ(fleet.broken(), 0) << seed;
    settled += fleet.settled();
  }
  EXPECT_GT(settled, 1000);
}

TEST(Reach, PromisesBeyondItMeetUnheard) {
  constexpr double kRange_m = 16.0;
  int broken = 0;
  for (int seed = 0; seed < 12; ++seed) {
    Roaming fleet(seed, kRange_m, {kRange_m, 2.0, 30.0});
    fleet.roam(40.0);
    broken += fleet.broken();
  }
  EXPECT_GT(broken, 0);
}

}  // namespace
}  // namespace mocha
