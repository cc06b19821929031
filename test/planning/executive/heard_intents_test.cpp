#include "planning/executive/heard_intents.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

using Heard = HeardIntents::Heard;

PassingIntent intent_of(const std::string& agent) {
  PassingIntent intent;
  intent.agent = agent;
  return intent;
}

TEST(HeardIntents, TellsWhatEachRobotHasSaidLast) {
  HeardIntents heard;
  EXPECT_TRUE(heard.all(0.0).empty());
  EXPECT_EQ(heard.of("a", 0.0), nullptr);
  heard.hear(intent_of("b"), 0.0);
  heard.hear(intent_of("a"), 0.1);
  PassingIntent later = intent_of("a");
  later.moves = 3;
  heard.hear(later, 0.2);
  const auto all = heard.all(0.3);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].agent, "a");
  EXPECT_EQ(all[0].moves, 3u);
  EXPECT_EQ(all[1].agent, "b");
  ASSERT_NE(heard.of("a", 0.3), nullptr);
  EXPECT_EQ(heard.of("a", 0.3)->moves, 3u);
  EXPECT_EQ(heard.of("c", 0.3), nullptr);
}

TEST(HeardIntents, WhatIsNotSaidAgainLapses) {
  HeardIntents heard;
  heard.hear(intent_of("a"), 10.0);
  heard.hear(intent_of("b"), 11.0);
  EXPECT_EQ(heard.all(11.4).size(), 2u);
  EXPECT_NE(heard.of("a", 11.4), nullptr);
  EXPECT_EQ(heard.of("a", 11.5), nullptr);
  ASSERT_EQ(heard.all(11.5).size(), 1u);
  EXPECT_EQ(heard.all(11.5)[0].agent, "b");
  heard.hear(intent_of("b"), 12.0);
  EXPECT_NE(heard.of("b", 13.4), nullptr);
  EXPECT_EQ(heard.of("b", 13.5), nullptr);
}

TEST(HeardIntents, IsNewsWhereCallsTheOrderTheMovesOrTheObstaclesChange) {
  HeardIntents heard;
  PassingIntent intent = intent_of("a");
  EXPECT_EQ(heard.hear(intent, 0.0), Heard::kNothingNew);
  EXPECT_EQ(heard.hear(intent, 0.1), Heard::kNothingNew);
  intent.calls = true;
  EXPECT_EQ(heard.hear(intent, 0.2), Heard::kNews);
  EXPECT_EQ(heard.hear(intent, 0.3), Heard::kNothingNew);
  intent.follows = {"b", 0, 1};
  EXPECT_EQ(heard.hear(intent, 0.4), Heard::kNews);
  intent.moves = 1;
  EXPECT_EQ(heard.hear(intent, 0.5), Heard::kNews);
  intent.obstacles = {Vector2(1.0, 2.0)};
  EXPECT_EQ(heard.hear(intent, 0.6), Heard::kNews);
  intent.goal = Vector2(1.0, 2.0);
  intent.priority = 1;
  intent.follows.epoch = 7;
  EXPECT_EQ(heard.hear(intent, 0.7), Heard::kNothingNew);
}

TEST(HeardIntents, IsNoNewsFromAnotherNorAfterItHasLapsed) {
  HeardIntents heard;
  heard.hear(intent_of("a"), 0.0);
  PassingIntent calls = intent_of("b");
  calls.calls = true;
  EXPECT_EQ(heard.hear(calls, 0.1), Heard::kNothingNew);
  calls.agent = "a";
  EXPECT_EQ(heard.hear(calls, 1.5), Heard::kNothingNew);
}

TEST(HeardIntents, KeepsSoManyNamesUntilTheyLapse) {
  constexpr int kMost = 256;
  HeardIntents heard;
  for (int i = 0; i < kMost; ++i) heard.hear(intent_of("robot" + std::to_string(i)), 0.1);
  EXPECT_EQ(heard.hear(intent_of("one more"), 0.2), Heard::kNoRoom);
  EXPECT_EQ(heard.all(0.2).size(), static_cast<std::size_t>(kMost));
  EXPECT_EQ(heard.of("one more", 0.2), nullptr);
  PassingIntent known = intent_of("robot7");
  known.calls = true;
  EXPECT_EQ(heard.hear(known, 1.0), Heard::kNews);
  heard.hear(intent_of("one more"), 1.7);  // only robot7 has not lapsed
  EXPECT_NE(heard.of("one more", 1.7), nullptr);
  EXPECT_EQ(heard.all(1.7).size(), 2u);
}

}  // namespace
}  // namespace mocha
