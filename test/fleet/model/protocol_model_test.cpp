// All that can happen to two and three robots of the real protocol, within the harm that each
// scenario allows, and faults that are planted and have to be found.
#include <gtest/gtest.h>

#include <cctype>
#include <deque>
#include <set>
#include <unordered_map>
#include <utility>

#include "fleet/model/explorer.h"
#include "fleet/model/protocol_fingerprint.h"
#include "fleet/model/scenarios.h"

namespace mocha {
namespace {

using test::Exploration;
using test::Fingerprint;
using test::Harm;
using test::Message;
using test::ProtocolModel;
using test::Scenario;

constexpr std::size_t kMostStates = 2'000'000;

class ProtocolModelOf : public ::testing::TestWithParam<Scenario> {};

TEST_P(ProtocolModelOf, IsSafeAndSomebodyWins) {
  const Exploration found = test::explore(GetParam(), kMostStates);
  EXPECT_TRUE(found.complete) << to_text(found);
  EXPECT_EQ(found.violation, "") << to_text(found);
  EXPECT_GT(found.states, 7000u);
  EXPECT_GT(found.settled, found.states / 10);
  EXPECT_GT(found.depth, 24);
}

INSTANTIATE_TEST_SUITE_P(ShortScenarios, ProtocolModelOf,
                         ::testing::ValuesIn(test::short_scenarios()), [](const auto& info) {
                           std::string name = info.param.name + std::to_string(info.index);
                           for (char& each : name) each = std::isalnum(each) ? each : '_';
                           return name;
                         });

Harm two_delays() {
  Harm harm;
  harm.delays = 2;
  return harm;
}

Harm one_restart() {
  Harm harm;
  harm.restarts = 1;
  return harm;
}

void expect_found(const Scenario& scenario, const std::string& violation) {
  const Exploration found = test::explore(scenario, kMostStates);
  EXPECT_NE(found.violation.find(violation), std::string::npos) << to_text(found);
  EXPECT_FALSE(found.counterexample.empty());
}

TEST(ProtocolModel, FindsRobotsThatEndorseWithoutLooking) {
  Scenario scenario = test::two_cross(two_delays());
  scenario.tamper = [](int, int to, Message& message) {
    if (auto* heartbeat = std::get_if<Heartbeat>(&message))
      heartbeat->acknowledgements.push_back(
          {test::name_of_robot(to), {1, 1000}, TrajectoryState::kProposed});
    return true;
  };
  expect_found(scenario, "settles what comes to");
}

TEST(ProtocolModel, FindsRobotsThatSettleWithoutEndorsements) {
  Scenario scenario = test::two_cross(two_delays());
  scenario.tamper = [](int, int, Message& message) {  // each takes the other for out of reach
    return !std::holds_alternative<Heartbeat>(message);
  };
  expect_found(scenario, "settles what comes to");
}

TEST(ProtocolModel, FindsAPromiseThatIsForgottenAtARestart) {
  Scenario scenario = test::one_restarts(one_restart());
  scenario.restart = test::Restart::kStandHere;
  expect_found(scenario, "settles what comes to");
}

/// The second robot has not heard of what the first settled out of its reach; and the first,
/// started anew, endorses what meets it.
TEST(ProtocolModel, FindsARestartedRobotThatDoesNotAskItsTracker) {
  Harm harm = one_restart();
  harm.cuts = 1;
  Scenario scenario = test::one_restarts(harm);
  scenario.restart = test::Restart::kNothing;
  expect_found(scenario, "ugv2 settles what comes to");
}

TEST(ProtocolModel, FindsRobotsThatMisreadTheirClocks) {
  Scenario scenario = test::two_cross({});
  scenario.tamper = [](int, int, Message& message) {
    if (auto* heartbeat = std::get_if<Heartbeat>(&message)) heartbeat->stamp_s += 3.0;
    return true;
  };
  expect_found(scenario, "settles what comes to");
}

/// Each takes the other to promise less far than it does, and so for far.
TEST(ProtocolModel, FindsRobotsThatTakeEachOtherForFar) {
  Scenario scenario = test::one_comes_near(two_delays());
  scenario.tamper = [](int, int, Message& message) {
    if (auto* heartbeat = std::get_if<Heartbeat>(&message)) heartbeat->promise_reach_m = 0.0;
    return true;
  };
  expect_found(scenario, "settles what comes to");
}

/// Of every message of a motion, the receiver reads another priority.
Scenario with_priority_read(int priority) {
  Scenario scenario = test::two_cross({});
  scenario.tamper = [priority](int, int, Message& message) {
    if (auto* trajectory = std::get_if<CommittedTrajectory>(&message))
      trajectory->priority = priority;
    return true;
  };
  return scenario;
}

TEST(ProtocolModel, FindsRobotsThatYieldToEachOther) {
  expect_found(with_priority_read(5), "nobody wins");
}

TEST(ProtocolModel, FindsRobotsThatWaitForEachOther) {
  expect_found(with_priority_read(-5), "waits in vain");
}

using Followers = std::set<std::pair<std::uint64_t, std::uint64_t>>;

Followers followers(const ProtocolModel& model) {
  Followers followers;
  for (const test::Action& action : model.actions()) {
    ProtocolModel next = model;
    next.apply(action);
    const Fingerprint print = ProtocolFingerprint::of(next);
    followers.insert({print.high, print.low});
  }
  return followers;
}

/// What a fingerprint leaves out changes nothing that happens: models that differ in that only lead
/// to the same states.
TEST(ProtocolModel, StatesOfOneFingerprintGoOnAlike) {
  Harm harm = one_restart();
  harm.losses = 1;
  const ProtocolModel start(std::make_shared<const Scenario>(test::one_restarts(harm)));
  std::unordered_map<Fingerprint, Followers> known;
  std::deque<ProtocolModel> open = {start};
  std::size_t again = 0;
  while (!open.empty() && known.size() < 20'000) {
    const ProtocolModel model = std::move(open.front());
    open.pop_front();
    const Followers found = followers(model);
    const auto [place, is_new] = known.emplace(ProtocolFingerprint::of(model), found);
    ASSERT_EQ(place->second, found);
    again += !is_new;
    if (!is_new) continue;
    for (const test::Action& action : model.actions()) {
      open.push_back(model);
      open.back().apply(action);
    }
  }
  EXPECT_GT(again, 1000u);
}

}  // namespace
}  // namespace mocha
