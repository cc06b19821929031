#include "fleet/protocol/commitment_protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fleet/protocol/motions.h"
#include "fleet/protocol/network.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

using State = CommitmentProtocol::State;
using Kind = CommitmentEvent::Kind;

constexpr double kRadius_m = 0.3;
constexpr double kStart_s = 10.0;
constexpr double kNow_s = 12.0;

Motion along_x(double start_s) { return test::drive(start_s, {{-3.0, 0.0}, {3.0, 0.0}}, 1.0); }
Motion along_y(double start_s) { return test::drive(start_s, {{0.0, -3.0}, {0.0, 3.0}}, 1.0); }

Proposal proposal(Motion motion, std::uint32_t tag = 7) {
  return {tag, kRadius_m, test::kRoverBraking, test::shared(std::move(motion))};
}

CommittedTrajectory of_peer(const std::string& name, TrajectoryId id, TrajectoryState state,
                            Motion motion) {
  CommittedTrajectory trajectory;
  trajectory.agent = name;
  trajectory.id = id;
  trajectory.state = state;
  trajectory.footprint_radius_m = kRadius_m;
  trajectory.braking = test::kRoverBraking;
  trajectory.motion = test::shared(std::move(motion));
  return trajectory;
}

Heartbeat heartbeat_of(const std::string& name,
                       std::vector<Acknowledgement> acknowledgements = {}) {
  return {name, 1, kNow_s, std::move(acknowledgements), {{"m", kNow_s, 0.0}}};
}

/// The robot "m", brought into a state at time kNow_s. Its motions go along x.
CommitmentProtocol robot_in(State state) {
  CommitmentProtocol robot(test::options("m"));
  robot.tick(state == State::kListening ? kNow_s - 0.1 : kStart_s);
  if (state == State::kListening) return robot;
  robot.tick(kNow_s - 0.1);
  if (state == State::kBound || state == State::kRevising) {
    robot.brake(proposal(test::stand(kNow_s - 0.1, {-3.0, 0.0})), kNow_s - 0.1);
  }
  if (state == State::kProposing || state == State::kRevising) {
    robot.propose(proposal(along_x(kNow_s + 1.0)), kNow_s);
  }
  robot.tick(kNow_s);
  return robot;
}

enum class Input {
  kPropose,
  kProposeLate,
  kProposeElsewhere,
  kBrake,
  kPeerHeartbeat,
  kMeetingProposalOfLowerRank,
  kMeetingProposalOfHigherRank,
  kMeetingPromise,
  kFarPromise,
  kDelayOver,
  kStartPassed,
};

CommitmentActions apply(CommitmentProtocol& robot, Input input) {
  switch (input) {
    case Input::kPropose:
      return robot.propose(proposal(along_x(kNow_s + 0.5)), kNow_s);
    case Input::kProposeLate:
      return robot.propose(proposal(along_x(kNow_s + 0.01)), kNow_s);
    case Input::kProposeElsewhere:
      return robot.propose(proposal(along_y(kNow_s + 0.5)), kNow_s);
    case Input::kBrake:
      return robot.brake(proposal(test::stand(kNow_s, {-3.0, 0.0})), kNow_s);
    case Input::kPeerHeartbeat:
      return robot.receive(heartbeat_of("z"), kNow_s);
    case Input::kMeetingProposalOfLowerRank:
      return robot.receive(of_peer("z", {1, 1}, TrajectoryState::kProposed, along_y(kNow_s + 1.0)),
                           kNow_s);
    case Input::kMeetingProposalOfHigherRank:
      return robot.receive(of_peer("a", {1, 1}, TrajectoryState::kProposed, along_y(kNow_s + 1.0)),
                           kNow_s);
    case Input::kMeetingPromise:
      return robot.receive(of_peer("z", {1, 1}, TrajectoryState::kCommitted, along_y(kNow_s + 1.0)),
                           kNow_s);
    case Input::kFarPromise:
      return robot.receive(
          of_peer("z", {1, 1}, TrajectoryState::kCommitted, test::stand(kNow_s, {0.0, 50.0})),
          kNow_s);
    case Input::kDelayOver:
      return robot.tick(kNow_s + 0.07);
    case Input::kStartPassed:
      return robot.tick(kNow_s + 1.01);
  }
  return {};
}

struct Expected {
  State state;  ///< afterwards
  Refusal refusal = Refusal::kNone;
  Kind kind = Kind::kRejected;  ///< of the event with this refusal
  bool settled = false;
};

TEST(CommitmentProtocol, EveryStateMeetsEveryEvent) {
  constexpr Expected kListens{State::kListening};
  constexpr Expected kIdles{State::kIdle};
  constexpr Expected kProposes{State::kProposing};
  constexpr Expected kHolds{State::kBound};
  constexpr Expected kRevises{State::kRevising};
  const auto refused = [](State state, Refusal why) { return Expected{state, why}; };
  const auto dropped = [](State state, Refusal why, bool settled) {
    return Expected{state, why, Kind::kWithdrawn, settled};
  };
  const auto settled = [](State state) {
    return Expected{state, Refusal::kNone, Kind::kRejected, true};
  };
  const Expected deaf = refused(State::kListening, Refusal::kListening);
  // In the order of State: listening, idle, proposing, bound, revising.
  const std::vector<std::pair<Input, std::vector<Expected>>> table = {
      {Input::kPropose,
       {deaf, kProposes, dropped(State::kProposing, Refusal::kReplaced, false), kRevises,
        dropped(State::kRevising, Refusal::kReplaced, false)}},
      {Input::kProposeLate,
       {deaf, refused(State::kIdle, Refusal::kTooLate), refused(State::kIdle, Refusal::kTooLate),
        refused(State::kBound, Refusal::kTooLate), refused(State::kBound, Refusal::kTooLate)}},
      {Input::kProposeElsewhere,  // without a binding motion it may begin anywhere
       {deaf, kProposes, dropped(State::kProposing, Refusal::kReplaced, false),
        refused(State::kBound, Refusal::kDiscontinuous),
        refused(State::kBound, Refusal::kDiscontinuous)}},
      {Input::kBrake,
       {settled(State::kListening), settled(State::kBound),
        dropped(State::kBound, Refusal::kEmergency, true), settled(State::kBound),
        dropped(State::kBound, Refusal::kEmergency, true)}},
      {Input::kPeerHeartbeat, {kListens, kIdles, kProposes, kHolds, kRevises}},
      {Input::kMeetingProposalOfLowerRank, {kListens, kIdles, kProposes, kHolds, kRevises}},
      {Input::kMeetingProposalOfHigherRank,
       {kListens, kIdles, refused(State::kIdle, Refusal::kPeerProposal), kHolds,
        refused(State::kBound, Refusal::kPeerProposal)}},
      {Input::kMeetingPromise,
       {kListens, kIdles, refused(State::kIdle, Refusal::kPeerPromise), kHolds,
        refused(State::kBound, Refusal::kPeerPromise)}},
      {Input::kFarPromise, {kListens, kIdles, kProposes, kHolds, kRevises}},
      {Input::kDelayOver,
       {kListens, kIdles, settled(State::kBound), kHolds, settled(State::kBound)}},
      {Input::kStartPassed,
       {kIdles, kIdles, refused(State::kIdle, Refusal::kTooLate), kHolds,
        refused(State::kBound, Refusal::kTooLate)}},
  };
  for (const auto& [input, row] : table) {
    ASSERT_EQ(row.size(), 5u);
    for (int i = 0; i < 5; ++i) {
      SCOPED_TRACE("input " + std::to_string(static_cast<int>(input)) + " in state " +
                   std::to_string(i));
      CommitmentProtocol robot = robot_in(static_cast<State>(i));
      ASSERT_EQ(robot.state(), static_cast<State>(i));
      const CommitmentActions actions = apply(robot, input);
      EXPECT_EQ(robot.state(), row[i].state);
      bool is_settled = false;
      bool is_refused = row[i].refusal == Refusal::kNone;
      for (const CommitmentEvent& event : actions.events) {
        is_settled = is_settled || event.kind == Kind::kSettled;
        is_refused = is_refused || (event.refusal == row[i].refusal && event.kind == row[i].kind);
      }
      EXPECT_EQ(is_settled, row[i].settled);
      EXPECT_TRUE(is_refused);
    }
  }
}

TEST(CommitmentProtocol, WaitsForThePeerInReach) {
  CommitmentProtocol robot = robot_in(State::kIdle);
  robot.receive(heartbeat_of("z"), kNow_s);
  const auto sent = robot.propose(proposal(along_x(kNow_s + 0.9), 42), kNow_s);
  ASSERT_EQ(sent.trajectories.size(), 1u);
  EXPECT_EQ(sent.trajectories[0].state, TrajectoryState::kProposed);
  const TrajectoryId id = sent.trajectories[0].id;
  EXPECT_EQ(id, (TrajectoryId{1, 1}));
  EXPECT_TRUE(robot.tick(kNow_s + 0.2).events.empty());
  // Of another epoch, another sequence, another robot.
  robot.receive(heartbeat_of("z", {{"m", {2, 1}, TrajectoryState::kProposed}}), kNow_s + 0.2);
  robot.receive(heartbeat_of("z", {{"m", {1, 0}, TrajectoryState::kProposed}}), kNow_s + 0.2);
  robot.receive(heartbeat_of("z", {{"k", {1, 1}, TrajectoryState::kProposed}}), kNow_s + 0.2);
  EXPECT_EQ(robot.state(), State::kProposing);
  const auto settled =
      robot.receive(heartbeat_of("z", {{"m", id, TrajectoryState::kProposed}}), kNow_s + 0.3);
  ASSERT_EQ(settled.events.size(), 1u);
  EXPECT_EQ(settled.events[0].kind, Kind::kSettled);
  EXPECT_EQ(settled.events[0].proposal.tag, 42u);
  ASSERT_GE(settled.trajectories.size(), 1u);
  EXPECT_EQ(settled.trajectories[0].state, TrajectoryState::kCommitted);
  EXPECT_EQ(settled.trajectories[0].id, id);
}

TEST(CommitmentProtocol, EndorsesWhatMeetsNothingAndOnlyThat) {
  const auto endorses = [](CommitmentProtocol robot, const std::string& peer, Motion motion) {
    robot.receive(heartbeat_of(peer), kNow_s);  // only now is the peer's clock known
    const auto actions =
        robot.receive(of_peer(peer, {1, 4}, TrajectoryState::kProposed, std::move(motion)), kNow_s);
    const Heartbeat heartbeat =
        actions.heartbeat ? *actions.heartbeat : *robot.tick(kNow_s + 0.2).heartbeat;
    for (const Acknowledgement& line : heartbeat.acknowledgements) {
      if (line.agent == peer && line.id == TrajectoryId{1, 4}) return true;
    }
    return false;
  };
  const Motion meeting = along_y(kNow_s + 1.0);
  const Motion over_its_place = test::drive(kNow_s + 1.0, {{-3.0, -3.0}, {-3.0, 3.0}}, 1.0);
  EXPECT_TRUE(endorses(robot_in(State::kListening), "z", meeting));
  EXPECT_TRUE(endorses(robot_in(State::kIdle), "z", meeting));
  EXPECT_FALSE(endorses(robot_in(State::kProposing), "z", meeting));  // ours ranks higher
  EXPECT_TRUE(endorses(robot_in(State::kProposing), "a", meeting));   // and is withdrawn
  EXPECT_FALSE(endorses(robot_in(State::kBound), "z", over_its_place));
  EXPECT_FALSE(endorses(robot_in(State::kBound), "a", over_its_place));  // whatever the rank
  EXPECT_TRUE(endorses(robot_in(State::kBound), "z", meeting));
}

TEST(CommitmentProtocol, HoldsWhileItCannotTellWhatAPeersClockShows) {
  CommitmentProtocol robot = robot_in(State::kIdle);
  Heartbeat heartbeat = heartbeat_of("z", {{"m", {1, 1}, TrajectoryState::kProposed}});
  heartbeat.echoes.clear();
  robot.receive(heartbeat, kNow_s);
  const auto sent = robot.propose(proposal(along_x(kNow_s + 0.5)), kNow_s);
  ASSERT_EQ(sent.trajectories.size(), 1u);
  robot.receive(heartbeat, kNow_s + 0.1);  // it endorses the motion
  EXPECT_EQ(robot.state(), State::kProposing);
  CommitmentProtocol waits = robot;
  const auto refused = waits.tick(kNow_s + 0.6);
  ASSERT_EQ(refused.events.size(), 1u);
  EXPECT_EQ(refused.events[0].refusal, Refusal::kClock);
  EXPECT_EQ(refused.events[0].conflict.peer, "z");
  robot.receive(heartbeat_of("z"), kNow_s + 0.2);
  EXPECT_EQ(robot.state(), State::kBound);
}

TEST(CommitmentProtocol, EndorsesAtLastWhenTheObstacleIsGone) {
  CommitmentProtocol robot = robot_in(State::kProposing);
  robot.receive(heartbeat_of("z"), kNow_s);
  robot.receive(of_peer("z", {1, 4}, TrajectoryState::kProposed, along_y(kNow_s + 1.0)), kNow_s);
  const auto actions =
      robot.propose(proposal(test::drive(kNow_s + 1.0, {{-3.0, 0.0}, {-3.0, 9.0}}, 1.0)), kNow_s);
  ASSERT_TRUE(actions.heartbeat);
  ASSERT_GE(actions.heartbeat->acknowledgements.size(), 1u);
  EXPECT_EQ(actions.heartbeat->acknowledgements[0].agent, "z");
}

/// Of a peer that stands apart from all others.
CommittedTrajectory apart(int number, std::uint32_t sequence) {
  return of_peer("z" + std::to_string(number), {1, sequence}, TrajectoryState::kProposed,
                 test::stand(kNow_s + 5.0, {10.0 * number, 50.0}));
}

bool endorses(const std::optional<Heartbeat>& heartbeat, const CommittedTrajectory& proposal) {
  if (!heartbeat) return false;
  return std::any_of(heartbeat->acknowledgements.begin(), heartbeat->acknowledgements.end(),
                     [&](const Acknowledgement& line) {
                       return line.agent == proposal.agent && line.id == proposal.id;
                     });
}

TEST(CommitmentProtocol, AnswersTheFirstProposalAtOnceAndFurtherOnesTogether) {
  CommitmentProtocol robot = robot_in(State::kIdle);
  for (int i = 1; i <= 3; ++i) robot.receive(heartbeat_of("z" + std::to_string(i)), kNow_s);
  const auto first = robot.receive(apart(1, 1), kNow_s + 0.01);
  EXPECT_TRUE(endorses(first.heartbeat, apart(1, 1)));
  EXPECT_FALSE(robot.receive(apart(2, 1), kNow_s + 0.015).heartbeat);
  EXPECT_FALSE(robot.receive(apart(3, 1), kNow_s + 0.02).heartbeat);
  EXPECT_FALSE(robot.tick(kNow_s + 0.03).heartbeat);
  const auto further = robot.tick(kNow_s + 0.036);
  EXPECT_TRUE(endorses(further.heartbeat, apart(2, 1)));
  EXPECT_TRUE(endorses(further.heartbeat, apart(3, 1)));
  EXPECT_FALSE(endorses(further.heartbeat, apart(1, 1)));  // was said already
  EXPECT_FALSE(robot.tick(kNow_s + 0.065).heartbeat);      // nothing is left to say
  const auto periodic = robot.tick(kNow_s + 0.11);
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(endorses(periodic.heartbeat, apart(i, 1)));
}

TEST(CommitmentProtocol, AnswersEveryProposalOfALargeFleetInFewHeartbeats) {
  constexpr int kPeers = 100;
  constexpr int kSteps = 200;
  constexpr double kStep_s = 0.005;
  CommitmentProtocol robot = robot_in(State::kIdle);
  for (int i = 0; i < kPeers; ++i) robot.receive(heartbeat_of("z" + std::to_string(i)), kNow_s);
  std::mt19937 random(5);
  std::vector<std::uint32_t> sequence(kPeers, 0);
  std::vector<std::pair<double, CommittedTrajectory>> waiting;
  int heartbeats = 0;
  int answered = 0;
  const auto read = [&](const CommitmentActions& actions, double now) {
    if (!actions.heartbeat) return;
    ++heartbeats;
    const auto done = std::stable_partition(waiting.begin(), waiting.end(), [&](const auto& each) {
      return !endorses(actions.heartbeat, each.second);
    });
    for (auto each = done; each != waiting.end(); ++each) {
      ++answered;
      EXPECT_LE(now - each->first, CommitmentProtocol::kAnswerPeriod_s + kStep_s);
    }
    waiting.erase(done, waiting.end());
  };
  int proposals = 0;
  for (int step = 1; step <= kSteps; ++step) {
    const double now = kNow_s + kStep_s * step;
    for (int k = 0; k < 5; ++k) {
      const int peer = static_cast<int>(random() % kPeers);
      const bool answers_are_out = std::none_of(waiting.begin(), waiting.end(), [&](auto& each) {
        return each.second.agent == "z" + std::to_string(peer);
      });
      if (!answers_are_out) continue;  // it would replace the former one
      const CommittedTrajectory proposal = apart(peer, ++sequence[peer]);
      waiting.emplace_back(now, proposal);
      ++proposals;
      read(robot.receive(proposal, now), now);
    }
    read(robot.tick(now), now);
  }
  EXPECT_GT(proposals, 800);
  EXPECT_GE(answered, proposals - 25);  // but those of the last moment
  EXPECT_LE(heartbeats, 40 + 10 + 2);   // in a second
}

TEST(CommitmentProtocol, GivesWayAtOnceWhenAHeartbeatTellsOfAPromise) {
  CommitmentProtocol robot = robot_in(State::kProposing);
  robot.receive(heartbeat_of("z"), kNow_s);
  robot.receive(of_peer("z", {1, 1}, TrajectoryState::kProposed, along_y(kNow_s + 1.0)), kNow_s);
  ASSERT_EQ(robot.state(), State::kProposing);  // outranked, it may still be withdrawn
  const auto actions =
      robot.receive(heartbeat_of("z", {{"z", {1, 1}, TrajectoryState::kCommitted}}), kNow_s + 0.01);
  ASSERT_EQ(actions.events.size(), 1u);
  EXPECT_EQ(actions.events[0].refusal, Refusal::kPeerPromise);
}

TEST(CommitmentProtocol, ListsItsOwnNewestInEveryHeartbeat) {
  CommitmentProtocol robot = robot_in(State::kRevising);
  const auto heartbeat = robot.tick(kNow_s + 0.01 + 0.1).heartbeat;  // settled by now
  ASSERT_TRUE(heartbeat);
  ASSERT_EQ(heartbeat->acknowledgements.size(), 1u);
  EXPECT_EQ(heartbeat->acknowledgements[0].id, (TrajectoryId{1, 2}));
  EXPECT_EQ(heartbeat->acknowledgements[0].state, TrajectoryState::kCommitted);

  CommitmentProtocol revising = robot_in(State::kBound);
  revising.receive(heartbeat_of("z"), kNow_s);
  revising.propose(proposal(along_x(kNow_s + 1.0)), kNow_s);
  const auto both = revising.tick(kNow_s + 0.11).heartbeat;
  ASSERT_TRUE(both);
  ASSERT_EQ(both->acknowledgements.size(), 2u);
  EXPECT_EQ(both->acknowledgements[0].state, TrajectoryState::kEmergency);
  EXPECT_EQ(both->acknowledgements[1].id, (TrajectoryId{1, 2}));
  EXPECT_EQ(both->acknowledgements[1].state, TrajectoryState::kProposed);
}

TEST(CommitmentProtocol, SendsAgainWhatIsNotSeen) {
  CommitmentProtocol robot = robot_in(State::kBound);
  robot.receive(heartbeat_of("z"), kNow_s);
  int sent = 0;
  for (int i = 1; i <= 90; ++i) {
    sent += static_cast<int>(robot.tick(kNow_s + 0.01 * i).trajectories.size());
  }
  EXPECT_GE(sent, 7);  // with every heartbeat
  robot.receive(heartbeat_of("z", {{"m", {1, 1}, TrajectoryState::kEmergency}}), kNow_s + 0.9);
  sent = 0;
  for (int i = 91; i <= 490; ++i) {
    sent += static_cast<int>(robot.tick(kNow_s + 0.01 * i).trajectories.size());
  }
  EXPECT_GE(sent, 3);  // once a second
  EXPECT_LE(sent, 5);
}

TEST(CommitmentProtocol, FollowsThePredecessorUntilTheNextMotionStarts) {
  // Settled early, starting late: the robot stands in the peer's way until then.
  CommitmentProtocol robot = robot_in(State::kRevising);
  robot.tick(kNow_s + 0.1);
  ASSERT_EQ(robot.state(), State::kBound);
  ASSERT_EQ(robot.binding().reservations().size(), 2u);
  EXPECT_NEAR(robot.binding().position(kNow_s + 0.5).x(), -3.0, 1e-9);
  EXPECT_NEAR(robot.binding().position(kNow_s + 1.0 + 6.0).x(), 3.0, 1e-9);
  robot.tick(kNow_s + 1.5);
  EXPECT_EQ(robot.binding().reservations().size(), 1u);
}

TEST(CommitmentProtocol, TellsWhenAPeerBreaksIn) {
  CommitmentProtocol robot = robot_in(State::kBound);
  const auto actions = robot.receive(
      of_peer("a", {1, 1}, TrajectoryState::kEmergency, test::stand(kNow_s, {-2.5, 0.0})), kNow_s);
  EXPECT_TRUE(actions.events.empty());  // both stand: no closer than they are
  const auto crash = robot.receive(of_peer("a", {1, 2}, TrajectoryState::kEmergency,
                                           test::drive(kNow_s, {{-2.5, 0.0}, {-2.7, 0.0}}, 0.5)),
                                   kNow_s);
  ASSERT_EQ(crash.events.size(), 1u);
  EXPECT_EQ(crash.events[0].kind, Kind::kBreached);
  EXPECT_EQ(crash.events[0].conflict.peer, "a");
}

TEST(CommitmentProtocol, IgnoresItsOwnNameAndRefusesNonsense) {
  CommitmentProtocol robot = robot_in(State::kProposing);
  robot.receive(of_peer("m", {9, 9}, TrajectoryState::kCommitted, along_y(kNow_s)), kNow_s);
  robot.receive(heartbeat_of("m"), kNow_s);
  EXPECT_EQ(robot.impostors(), 2);
  EXPECT_TRUE(robot.peers().peers().empty());
  EXPECT_EQ(robot.state(), State::kProposing);

  EXPECT_THROW(robot.propose({1, kRadius_m, test::kRoverBraking, nullptr}, kNow_s),
               std::invalid_argument);
  const auto stand = test::shared(test::stand(kNow_s + 1.0, {-3.0, 0.0}));
  EXPECT_THROW(robot.propose({1, kRadius_m, std::nullopt, stand}, kNow_s), std::invalid_argument);
  EXPECT_THROW(robot.propose({1, kRadius_m, Braking(0.001), stand}, kNow_s), std::invalid_argument);
  EXPECT_THROW(
      robot.propose({1, -0.1, test::kRoverBraking, test::shared(along_x(kNow_s + 1.0))}, kNow_s),
      std::invalid_argument);
  EXPECT_THROW(
      robot.brake({1, 11.0, test::kRoverBraking, test::shared(along_x(kNow_s + 1.0))}, kNow_s),
      std::invalid_argument);
  const Motion fast = test::drive(kNow_s + 1.0, {{0.0, 0.0}, {500.0, 0.0}}, 100.0);
  EXPECT_THROW(robot.propose({1, kRadius_m, test::kRoverBraking, test::shared(fast)}, kNow_s),
               std::invalid_argument);
  EXPECT_EQ(robot.state(), State::kProposing);  // without any effect

  CommitmentOptions options = test::options("m");
  options.reach.promise_m = 0.0;
  EXPECT_THROW(CommitmentProtocol{options}, std::invalid_argument);
  options = test::options("m");
  options.delta_dc_s = -0.1;
  EXPECT_THROW(CommitmentProtocol{options}, std::invalid_argument);
  options = test::options("m");
  options.clocks.tolerance_s = -0.1;
  EXPECT_THROW(CommitmentProtocol{options}, std::invalid_argument);
  EXPECT_THROW(CommitmentProtocol{test::options("")}, std::invalid_argument);
}

}  // namespace
}  // namespace mocha
