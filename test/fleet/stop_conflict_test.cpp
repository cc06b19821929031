#include "fleet/protocol/stop_conflict.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fleet/protocol/network.h"
#include "trajectory/rover_braking.h"
#include "trajectory/stop_separation.h"

namespace mocha {
namespace {

using Kind = CommitmentEvent::Kind;

constexpr double kNow_s = 20.0;
constexpr double kRadius_m = 0.3;
constexpr double kReaction_s = 0.3;

CommitmentOptions with_stops(const std::string& agent) {
  CommitmentOptions options = test::options(agent);
  options.peer_clearance_m = 0.0;
  options.stop_reaction_s = kReaction_s;
  return options;
}

CommittedTrajectory trajectory(const std::string& agent, std::uint32_t sequence,
                               TrajectoryState state, Motion motion,
                               const Braking& braking = test::kRoverBraking) {
  CommittedTrajectory trajectory;
  trajectory.agent = agent;
  trajectory.id = {1, sequence};
  trajectory.state = state;
  trajectory.footprint_radius_m = kRadius_m;
  trajectory.braking = braking;
  trajectory.motion = test::shared(std::move(motion));
  return trajectory;
}

/// Through the origin at about 1 m/s, four metres after `start_s`.
Motion along_x(double start_s) { return test::drive(start_s, {{-4.0, 0.0}, {4.0, 0.0}}, 0.6); }
Motion along_y(double start_s) { return test::drive(start_s, {{0.0, -4.0}, {0.0, 4.0}}, 0.6); }

/// Knows that "z" stands and has promised along_y(); stands itself at (-4, 0).
CommitmentProtocol robot_beside_a_promise(const CommitmentOptions& options) {
  CommitmentProtocol robot(options);
  robot.tick(kNow_s - 2.0);
  robot.tick(kNow_s);
  const auto stand = test::shared(test::stand(kNow_s, {-4.0, 0.0}));
  robot.brake({1, kRadius_m, test::kRoverBraking, stand}, kNow_s);
  robot.receive(
      trajectory("z", 1, TrajectoryState::kEmergency, test::stand(kNow_s - 1.0, {0.0, -4.0})),
      kNow_s);
  robot.receive(trajectory("z", 2, TrajectoryState::kCommitted, along_y(kNow_s + 1.0)), kNow_s);
  return robot;
}

/// What becomes of the motion; nothing while that is open.
std::vector<CommitmentEvent> proposed(CommitmentProtocol& robot, Motion motion,
                                      const Braking& braking = test::kRoverBraking) {
  auto events =
      robot.propose({2, kRadius_m, braking, test::shared(std::move(motion))}, kNow_s).events;
  const auto later = robot.tick(kNow_s + 0.1).events;
  events.insert(events.end(), later.begin(), later.end());
  return events;
}

TEST(StopConflict, ARobotThatWouldStopInTheWayIsRefused) {
  CommitmentOptions options = with_stops("m");
  constexpr double kLater_s = 0.85;  // both drive on: more than 0.6 m apart; one brakes: less
  CommitmentProtocol robot = robot_beside_a_promise(options);
  const auto refused = proposed(robot, along_x(kNow_s + 1.0 + kLater_s));
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].refusal, Refusal::kPeerPromise);
  EXPECT_TRUE(refused[0].conflict.by_stopping);
  EXPECT_EQ(refused[0].conflict.peer, "z");
  EXPECT_LT(refused[0].conflict.distance_m, 2.0 * kRadius_m);

  CommitmentProtocol later = robot_beside_a_promise(options);
  const auto settled = proposed(later, along_x(kNow_s + 1.0 + 3.0));
  ASSERT_EQ(settled.size(), 1u);
  EXPECT_EQ(settled[0].kind, Kind::kSettled);

  options.stop_reaction_s.reset();
  CommitmentProtocol careless = robot_beside_a_promise(options);
  const auto taken = proposed(careless, along_x(kNow_s + 1.0 + kLater_s));
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_EQ(taken[0].kind, Kind::kSettled);
}

TEST(StopConflict, ARobotInTheWayOfAStopDoesNotAgree) {
  for (const bool checks : {true, false}) {
    CommitmentOptions options = with_stops("m");
    if (!checks) options.stop_reaction_s.reset();
    CommitmentProtocol robot(options);
    robot.tick(kNow_s - 2.0);
    robot.tick(kNow_s);
    robot.brake({1, kRadius_m, test::kRoverBraking, test::shared(along_x(kNow_s + 1.0))}, kNow_s);
    robot.receive(Heartbeat{"z", 1, kNow_s, {}, {{"m", kNow_s, 0.0}}}, kNow_s);
    robot.receive(trajectory("z", 1, TrajectoryState::kProposed, along_y(kNow_s + 1.85)), kNow_s);
    const bool agrees = robot.peers().peers().at("z").endorsed == TrajectoryId{1, 1};
    EXPECT_EQ(agrees, !checks);
  }
}

const Braking kGentle(0.2, 0.8);

/// Two on one lane, at the same times.
Motion leads() { return test::drive(kNow_s + 1.0, {{0.0, 0.0}, {8.0, 0.0}}, 0.6); }
Motion follows() { return test::drive(kNow_s + 1.0, {{-1.4, 0.0}, {6.6, 0.0}}, 0.6); }

/// Whether "m" may promise the one motion beside "z", which has promised the other.
bool may_promise(const BrakableMotion& mine, const BrakableMotion& theirs) {
  CommitmentProtocol robot(with_stops("m"));
  robot.tick(kNow_s - 2.0);
  robot.receive(trajectory("z", 1, TrajectoryState::kCommitted, theirs.motion, theirs.braking),
                kNow_s);
  const auto events = proposed(robot, mine.motion, mine.braking);
  EXPECT_EQ(events.size(), 1u);
  return events.at(0).kind == Kind::kSettled;
}

/// Whether "m", which has promised the one motion, agrees where "z" proposes the other.
bool agrees(const BrakableMotion& mine, const BrakableMotion& theirs) {
  CommitmentProtocol robot(with_stops("m"));
  robot.tick(kNow_s - 2.0);
  robot.tick(kNow_s);
  robot.brake({1, kRadius_m, mine.braking, test::shared(mine.motion)}, kNow_s);
  robot.receive(Heartbeat{"z", 1, kNow_s, {}, {{"m", kNow_s, 0.0}}}, kNow_s);
  robot.receive(trajectory("z", 1, TrajectoryState::kProposed, theirs.motion, theirs.braking),
                kNow_s);
  return robot.peers().peers().at("z").endorsed == TrajectoryId{1, 1};
}

TEST(StopConflict, EitherRobotIsTakenToBrakeAsItSays) {
  for (const Braking& first : {test::kRoverBraking, kGentle}) {
    for (const Braking& second : {test::kRoverBraking, kGentle}) {
      const Motion ahead = leads();
      const Motion behind = follows();
      const BrakableMotion leader{ahead, first};
      const BrakableMotion follower{behind, second};
      // One that brakes gently runs into one that brakes hard ahead of it, and no other does.
      const bool compatible = first.deceleration() <= second.deceleration();
      EXPECT_EQ(may_promise(leader, follower), compatible);
      EXPECT_EQ(may_promise(follower, leader), compatible);
      EXPECT_EQ(agrees(leader, follower), compatible);
      EXPECT_EQ(agrees(follower, leader), compatible);
    }
  }
}

TEST(StopConflict, RobotsSetDownTooCloseMayLeaveButComeNoCloser) {
  for (const bool leaves : {true, false}) {
    CommitmentOptions options = with_stops("m");
    options.stop_clearance_m = 0.2;
    CommitmentProtocol robot(options);
    robot.tick(kNow_s - 2.0);
    robot.tick(kNow_s);
    robot.brake({1, kRadius_m, test::kRoverBraking, test::shared(test::stand(kNow_s, {0.0, 0.0}))},
                kNow_s);
    robot.receive(trajectory("z", 1, TrajectoryState::kEmergency, test::stand(kNow_s, {0.7, 0.0})),
                  kNow_s);
    const double goal_m = leaves ? -3.0 : 0.05;
    const auto events =
        proposed(robot, test::drive(kNow_s + 0.5, {{0.0, 0.0}, {goal_m, 0.0}}, 0.5));
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, leaves ? Kind::kSettled : Kind::kRejected);
  }
}

TEST(StopConflict, FollowsARobotFromWhatIsBindingIntoItsProposal) {
  // z leads at 1 m/s; m stands, and is to follow close behind from a moment that falls into the
  // reaction time.
  ReservationChain mine;
  mine.bind(trajectory("m", 1, TrajectoryState::kCommitted, test::stand(kNow_s, {0.0, 0.0})));
  ReservationChain theirs;
  theirs.bind(trajectory("z", 1, TrajectoryState::kCommitted,
                         test::drive(kNow_s - 1.0, {{0.9, 0.0}, {6.5, 0.0}}, 0.5)));
  const CommittedTrajectory follows = trajectory(
      "m", 2, TrajectoryState::kProposed, test::drive(kNow_s + 1.2, {{0.0, 0.0}, {5.8, 0.0}}, 0.6));
  const StopDemand demand{2.0, 0.0, 10.0};  // hears late
  EXPECT_FALSE(first_stop_conflict({mine, nullptr}, {theirs, nullptr}, demand, kNow_s + 0.9));
  const auto conflict =
      first_stop_conflict({mine, &follows}, {theirs, nullptr}, demand, kNow_s + 0.9);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->peer, "z");
}

TEST(StopConflict, RacesOfDifferentRobotsOverABadNetworkEndWithRoomToBrake) {
  test::Network::Link link;
  link.max_delay_s = 0.2;
  link.loss = 0.2;
  int settled = 0;
  int refused = 0;
  for (int seed = 0; seed < 150; ++seed) {
    test::Network network(seed, link);
    network.add(with_stops("ugv1"), kGentle);
    network.add(with_stops("ugv2"));
    network.add(with_stops("ugv3"), Braking(1.2, 2.0));
    for (int i = 0; i < network.size(); ++i)
      network.brake(i, test::stand(network.now(), {3.0 * i, -3.0}));
    network.run(1.2);
    std::uniform_real_distribution<double> x(0.0, 6.0);
    for (int i = 0; i < network.size(); ++i) {
      auto& random = network.random();
      const Vector2 middle(x(random), 0.0);
      network.propose(
          i, test::drive(network.now() + 1.0, {{3.0 * i, -3.0}, middle, {x(random), 3.0}}, 0.8));
      network.run(0.05);
    }
    network.run(1.5);
    const StopDemand demand{kReaction_s, -0.02, 10.0};
    for (int i = 0; i < network.size(); ++i) {
      settled += network.settled(i) - 1;
      refused += static_cast<int>(network.events(i, Kind::kRejected).size());
      for (int k = 0; k < i; ++k) {
        EXPECT_FALSE(first_stop_conflict({network.robot(i).binding(), nullptr},
                                         {network.robot(k).binding(), nullptr}, demand,
                                         network.now()))
            << seed;
      }
    }
  }
  EXPECT_GT(settled, 150);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace mocha
