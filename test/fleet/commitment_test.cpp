#include "fleet/commitment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fleet/motions.h"
#include "fleet/network.h"

namespace mocha {
namespace {

using State = Commitment::State;
using Kind = CommitmentEvent::Kind;

constexpr double kRadius_m = 0.3;
constexpr double kStart_s = 10.0;
constexpr double kNow_s = 12.0;

Motion along_x(double start_s) { return test::drive(start_s, {{-3.0, 0.0}, {3.0, 0.0}}, 1.0); }
Motion along_y(double start_s) { return test::drive(start_s, {{0.0, -3.0}, {0.0, 3.0}}, 1.0); }

Proposal proposal(Motion motion, std::uint32_t tag = 7) {
  return {tag, kRadius_m, test::shared(std::move(motion))};
}

Promise of_peer(const std::string& name, PromiseId id, PromiseState state, Motion motion) {
  Promise promise;
  promise.agent = name;
  promise.id = id;
  promise.state = state;
  promise.footprint_radius_m = kRadius_m;
  promise.motion = test::shared(std::move(motion));
  return promise;
}

Beat beat_of(const std::string& name, std::vector<Seen> seen = {}) {
  return {name, 1, kNow_s, std::move(seen), {{"m", kNow_s, 0.0}}};
}

/// The robot "m", brought into a state at time kNow_s. Its motions go along x.
Commitment robot_in(State state) {
  Commitment robot(test::settings("m"));
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
  kPeerBeat,
  kMeetingProposalOfLowerRank,
  kMeetingProposalOfHigherRank,
  kMeetingPromise,
  kFarPromise,
  kDelayOver,
  kStartPassed,
};

CommitmentActions apply(Commitment& robot, Input input) {
  switch (input) {
    case Input::kPropose:
      return robot.propose(proposal(along_x(kNow_s + 0.5)), kNow_s);
    case Input::kProposeLate:
      return robot.propose(proposal(along_x(kNow_s + 0.01)), kNow_s);
    case Input::kProposeElsewhere:
      return robot.propose(proposal(along_y(kNow_s + 0.5)), kNow_s);
    case Input::kBrake:
      return robot.brake(proposal(test::stand(kNow_s, {-3.0, 0.0})), kNow_s);
    case Input::kPeerBeat:
      return robot.receive(beat_of("z"), kNow_s);
    case Input::kMeetingProposalOfLowerRank:
      return robot.receive(of_peer("z", {1, 1}, PromiseState::kProposed, along_y(kNow_s + 1.0)),
                           kNow_s);
    case Input::kMeetingProposalOfHigherRank:
      return robot.receive(of_peer("a", {1, 1}, PromiseState::kProposed, along_y(kNow_s + 1.0)),
                           kNow_s);
    case Input::kMeetingPromise:
      return robot.receive(of_peer("z", {1, 1}, PromiseState::kCommitted, along_y(kNow_s + 1.0)),
                           kNow_s);
    case Input::kFarPromise:
      return robot.receive(
          of_peer("z", {1, 1}, PromiseState::kCommitted, test::stand(kNow_s, {0.0, 50.0})), kNow_s);
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

TEST(Commitment, EveryStateMeetsEveryEvent) {
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
      {Input::kPeerBeat, {kListens, kIdles, kProposes, kHolds, kRevises}},
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
      Commitment robot = robot_in(static_cast<State>(i));
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

TEST(Commitment, WaitsForThePeerInReach) {
  Commitment robot = robot_in(State::kIdle);
  robot.receive(beat_of("z"), kNow_s);
  const auto sent = robot.propose(proposal(along_x(kNow_s + 0.9), 42), kNow_s);
  ASSERT_EQ(sent.promises.size(), 1u);
  EXPECT_EQ(sent.promises[0].state, PromiseState::kProposed);
  const PromiseId id = sent.promises[0].id;
  EXPECT_EQ(id, (PromiseId{1, 1}));
  EXPECT_TRUE(robot.tick(kNow_s + 0.2).events.empty());
  // Of another epoch, another sequence, another robot.
  robot.receive(beat_of("z", {{"m", {2, 1}, PromiseState::kProposed}}), kNow_s + 0.2);
  robot.receive(beat_of("z", {{"m", {1, 0}, PromiseState::kProposed}}), kNow_s + 0.2);
  robot.receive(beat_of("z", {{"k", {1, 1}, PromiseState::kProposed}}), kNow_s + 0.2);
  EXPECT_EQ(robot.state(), State::kProposing);
  const auto settled =
      robot.receive(beat_of("z", {{"m", id, PromiseState::kProposed}}), kNow_s + 0.3);
  ASSERT_EQ(settled.events.size(), 1u);
  EXPECT_EQ(settled.events[0].kind, Kind::kSettled);
  EXPECT_EQ(settled.events[0].proposal.tag, 42u);
  ASSERT_GE(settled.promises.size(), 1u);
  EXPECT_EQ(settled.promises[0].state, PromiseState::kCommitted);
  EXPECT_EQ(settled.promises[0].id, id);
}

TEST(Commitment, EndorsesWhatMeetsNothingAndOnlyThat) {
  const auto endorses = [](Commitment robot, const std::string& peer, Motion motion) {
    robot.receive(beat_of(peer), kNow_s);  // only now is the peer's clock known
    const auto actions =
        robot.receive(of_peer(peer, {1, 4}, PromiseState::kProposed, std::move(motion)), kNow_s);
    const Beat beat = actions.beat ? *actions.beat : *robot.tick(kNow_s + 0.2).beat;
    for (const Seen& line : beat.seen) {
      if (line.agent == peer && line.id == PromiseId{1, 4}) return true;
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

TEST(Commitment, HoldsWhileItCannotTellWhatAPeersClockShows) {
  Commitment robot = robot_in(State::kIdle);
  Beat beat = beat_of("z", {{"m", {1, 1}, PromiseState::kProposed}});
  beat.echoes.clear();
  robot.receive(beat, kNow_s);
  const auto sent = robot.propose(proposal(along_x(kNow_s + 0.5)), kNow_s);
  ASSERT_EQ(sent.promises.size(), 1u);
  robot.receive(beat, kNow_s + 0.1);  // it endorses the motion
  EXPECT_EQ(robot.state(), State::kProposing);
  Commitment waits = robot;
  const auto refused = waits.tick(kNow_s + 0.6);
  ASSERT_EQ(refused.events.size(), 1u);
  EXPECT_EQ(refused.events[0].refusal, Refusal::kClock);
  EXPECT_EQ(refused.events[0].conflict.peer, "z");
  robot.receive(beat_of("z"), kNow_s + 0.2);
  EXPECT_EQ(robot.state(), State::kBound);
}

TEST(Commitment, EndorsesAtLastWhenTheObstacleIsGone) {
  Commitment robot = robot_in(State::kProposing);
  robot.receive(beat_of("z"), kNow_s);
  robot.receive(of_peer("z", {1, 4}, PromiseState::kProposed, along_y(kNow_s + 1.0)), kNow_s);
  const auto actions =
      robot.propose(proposal(test::drive(kNow_s + 1.0, {{-3.0, 0.0}, {-3.0, 9.0}}, 1.0)), kNow_s);
  ASSERT_TRUE(actions.beat);
  ASSERT_GE(actions.beat->seen.size(), 1u);
  EXPECT_EQ(actions.beat->seen[0].agent, "z");
}

/// Of a peer that stands apart from all others.
Promise apart(int number, std::uint32_t sequence) {
  return of_peer("z" + std::to_string(number), {1, sequence}, PromiseState::kProposed,
                 test::stand(kNow_s + 5.0, {10.0 * number, 50.0}));
}

bool endorses(const std::optional<Beat>& beat, const Promise& proposal) {
  if (!beat) return false;
  return std::any_of(beat->seen.begin(), beat->seen.end(), [&](const Seen& line) {
    return line.agent == proposal.agent && line.id == proposal.id;
  });
}

TEST(Commitment, AnswersTheFirstProposalAtOnceAndFurtherOnesTogether) {
  Commitment robot = robot_in(State::kIdle);
  for (int i = 1; i <= 3; ++i) robot.receive(beat_of("z" + std::to_string(i)), kNow_s);
  const auto first = robot.receive(apart(1, 1), kNow_s + 0.01);
  EXPECT_TRUE(endorses(first.beat, apart(1, 1)));
  EXPECT_FALSE(robot.receive(apart(2, 1), kNow_s + 0.015).beat);
  EXPECT_FALSE(robot.receive(apart(3, 1), kNow_s + 0.02).beat);
  EXPECT_FALSE(robot.tick(kNow_s + 0.03).beat);
  const auto further = robot.tick(kNow_s + 0.036);
  EXPECT_TRUE(endorses(further.beat, apart(2, 1)));
  EXPECT_TRUE(endorses(further.beat, apart(3, 1)));
  EXPECT_FALSE(endorses(further.beat, apart(1, 1)));  // was said already
  EXPECT_FALSE(robot.tick(kNow_s + 0.065).beat);      // nothing is left to say
  const auto periodic = robot.tick(kNow_s + 0.11);
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(endorses(periodic.beat, apart(i, 1)));
}

TEST(Commitment, AnswersEveryProposalOfALargeFleetInFewHeartbeats) {
  constexpr int kPeers = 100;
  constexpr int kSteps = 200;
  constexpr double kStep_s = 0.005;
  Commitment robot = robot_in(State::kIdle);
  for (int i = 0; i < kPeers; ++i) robot.receive(beat_of("z" + std::to_string(i)), kNow_s);
  std::mt19937 random(5);
  std::vector<std::uint32_t> sequence(kPeers, 0);
  std::vector<std::pair<double, Promise>> waiting;
  int beats = 0;
  int answered = 0;
  const auto read = [&](const CommitmentActions& actions, double now) {
    if (!actions.beat) return;
    ++beats;
    const auto done = std::stable_partition(waiting.begin(), waiting.end(), [&](const auto& each) {
      return !endorses(actions.beat, each.second);
    });
    for (auto each = done; each != waiting.end(); ++each) {
      ++answered;
      EXPECT_LE(now - each->first, robot.settings().answer_period_s + kStep_s);
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
      const Promise proposal = apart(peer, ++sequence[peer]);
      waiting.emplace_back(now, proposal);
      ++proposals;
      read(robot.receive(proposal, now), now);
    }
    read(robot.tick(now), now);
  }
  EXPECT_GT(proposals, 800);
  EXPECT_GE(answered, proposals - 25);  // but those of the last moment
  EXPECT_LE(beats, 40 + 10 + 2);        // in a second
}

TEST(Commitment, GivesWayAtOnceWhenAHeartbeatTellsOfAPromise) {
  Commitment robot = robot_in(State::kProposing);
  robot.receive(beat_of("z"), kNow_s);
  robot.receive(of_peer("z", {1, 1}, PromiseState::kProposed, along_y(kNow_s + 1.0)), kNow_s);
  ASSERT_EQ(robot.state(), State::kProposing);  // outranked, it may still be withdrawn
  const auto actions =
      robot.receive(beat_of("z", {{"z", {1, 1}, PromiseState::kCommitted}}), kNow_s + 0.01);
  ASSERT_EQ(actions.events.size(), 1u);
  EXPECT_EQ(actions.events[0].refusal, Refusal::kPeerPromise);
}

TEST(Commitment, ListsItsOwnNewestInEveryBeat) {
  Commitment robot = robot_in(State::kRevising);
  const auto beat = robot.tick(kNow_s + 0.01 + 0.1).beat;  // settled by now
  ASSERT_TRUE(beat);
  ASSERT_EQ(beat->seen.size(), 1u);
  EXPECT_EQ(beat->seen[0].id, (PromiseId{1, 2}));
  EXPECT_EQ(beat->seen[0].state, PromiseState::kCommitted);

  Commitment revising = robot_in(State::kBound);
  revising.receive(beat_of("z"), kNow_s);
  revising.propose(proposal(along_x(kNow_s + 1.0)), kNow_s);
  const auto both = revising.tick(kNow_s + 0.11).beat;
  ASSERT_TRUE(both);
  ASSERT_EQ(both->seen.size(), 2u);
  EXPECT_EQ(both->seen[0].state, PromiseState::kEmergency);
  EXPECT_EQ(both->seen[1].id, (PromiseId{1, 2}));
  EXPECT_EQ(both->seen[1].state, PromiseState::kProposed);
}

TEST(Commitment, SendsAgainWhatIsNotSeen) {
  Commitment robot = robot_in(State::kBound);
  robot.receive(beat_of("z"), kNow_s);
  int sent = 0;
  for (int i = 1; i <= 90; ++i) {
    sent += static_cast<int>(robot.tick(kNow_s + 0.01 * i).promises.size());
  }
  EXPECT_GE(sent, 7);  // with every heartbeat
  robot.receive(beat_of("z", {{"m", {1, 1}, PromiseState::kEmergency}}), kNow_s + 0.9);
  sent = 0;
  for (int i = 91; i <= 490; ++i) {
    sent += static_cast<int>(robot.tick(kNow_s + 0.01 * i).promises.size());
  }
  EXPECT_GE(sent, 3);  // once a second
  EXPECT_LE(sent, 5);
}

TEST(Commitment, FollowsThePredecessorUntilTheNextMotionStarts) {
  // Settled early, starting late: the robot stands in the peer's way until then.
  Commitment robot = robot_in(State::kRevising);
  robot.tick(kNow_s + 0.1);
  ASSERT_EQ(robot.state(), State::kBound);
  ASSERT_EQ(robot.binding().claims().size(), 2u);
  EXPECT_NEAR(robot.binding().position(kNow_s + 0.5).x(), -3.0, 1e-9);
  EXPECT_NEAR(robot.binding().position(kNow_s + 1.0 + 6.0).x(), 3.0, 1e-9);
  robot.tick(kNow_s + 1.5);
  EXPECT_EQ(robot.binding().claims().size(), 1u);
}

TEST(Commitment, TellsWhenAPeerBreaksIn) {
  Commitment robot = robot_in(State::kBound);
  const auto actions = robot.receive(
      of_peer("a", {1, 1}, PromiseState::kEmergency, test::stand(kNow_s, {-2.5, 0.0})), kNow_s);
  EXPECT_TRUE(actions.events.empty());  // both stand: no closer than they are
  const auto crash = robot.receive(of_peer("a", {1, 2}, PromiseState::kEmergency,
                                           test::drive(kNow_s, {{-2.5, 0.0}, {-2.7, 0.0}}, 0.5)),
                                   kNow_s);
  ASSERT_EQ(crash.events.size(), 1u);
  EXPECT_EQ(crash.events[0].kind, Kind::kBreached);
  EXPECT_EQ(crash.events[0].conflict.peer, "a");
}

TEST(Commitment, IgnoresItsOwnNameAndRefusesNonsense) {
  Commitment robot = robot_in(State::kProposing);
  robot.receive(of_peer("m", {9, 9}, PromiseState::kCommitted, along_y(kNow_s)), kNow_s);
  robot.receive(beat_of("m"), kNow_s);
  EXPECT_EQ(robot.impostors(), 2);
  EXPECT_TRUE(robot.peers().peers().empty());
  EXPECT_EQ(robot.state(), State::kProposing);

  EXPECT_THROW(robot.propose({1, kRadius_m, nullptr}, kNow_s), std::invalid_argument);
  EXPECT_THROW(robot.propose({1, -0.1, test::shared(along_x(kNow_s + 1.0))}, kNow_s),
               std::invalid_argument);
  EXPECT_THROW(robot.brake({1, 11.0, test::shared(along_x(kNow_s + 1.0))}, kNow_s),
               std::invalid_argument);
  const Motion fast = test::drive(kNow_s + 1.0, {{0.0, 0.0}, {500.0, 0.0}}, 100.0);
  EXPECT_THROW(robot.propose({1, kRadius_m, test::shared(fast)}, kNow_s), std::invalid_argument);
  EXPECT_EQ(robot.state(), State::kProposing);  // without any effect

  CommitmentSettings settings = test::settings("m");
  settings.delta_dc_s = -0.1;
  EXPECT_THROW(Commitment{settings}, std::invalid_argument);
  settings = test::settings("m");
  settings.answer_period_s = -0.1;
  EXPECT_THROW(Commitment{settings}, std::invalid_argument);
  EXPECT_THROW(Commitment{test::settings("")}, std::invalid_argument);
}

}  // namespace
}  // namespace mocha
