#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fleet/wire/passing_parts.h"
#include "fleet/wire/wire_format.h"

namespace mocha {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kWidth = 1.0 / 3.0;  // [m] of a cell: no place is a round number

Bytes encoded(const FleetMessage& message) { return encode({17, message}); }

template <typename Message>
Message told(const Message& message) {
  const Bytes bytes = encoded(message);
  return std::get<Message>(decode(bytes.data(), bytes.size()).message);
}

PassingIntent intent() {
  return {"ugv12", 7, -3, true, 0.333, Vector2(12.34567, -4.2), {"ugv3", 2, 9}, 14};
}

/// As an order makes them: each turn goes on where the one before ended, by a bend, and waits for
/// two others.
PassingInstruction instruction(std::uint32_t turns, const Vector2& origin = {3.0, -7.0}) {
  PassingInstruction whole{{"ugv3", 2, 9}, "ugv2", {}, turns, turns / 2, 0, {}};
  for (int i = 1; i <= 12; ++i) whole.robots.push_back("ugv" + std::to_string(i));
  Vector2 place = origin;
  for (std::uint32_t i = 0; i < turns; ++i) {
    const Vector2 bend = place + kWidth * Vector2(std::cos(0.7 * i), std::sin(0.7 * i));
    const Vector2 end = bend + kWidth * Vector2(1.0, 0.0);
    whole.part.push_back({{place, bend, end}, {{0, 1 + i}, {5, 1 + i / 2}}});
    place = end;
  }
  return whole;
}

void expect_same(const PassingInstruction& a, const PassingInstruction& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.robot, b.robot);
  EXPECT_EQ(a.robots, b.robots);
  EXPECT_EQ(a.turns, b.turns);
  EXPECT_EQ(a.alone_from, b.alone_from);
  EXPECT_EQ(a.first, b.first);
  ASSERT_EQ(a.part.size(), b.part.size());
  for (std::size_t i = 0; i < a.part.size(); ++i) {
    EXPECT_EQ(a.part[i].path, b.part[i].path);
    ASSERT_EQ(a.part[i].after.size(), b.part[i].after.size());
    for (std::size_t k = 0; k < a.part[i].after.size(); ++k) {
      EXPECT_EQ(a.part[i].after[k].robot, b.part[i].after[k].robot);
      EXPECT_EQ(a.part[i].after[k].moves, b.part[i].after[k].moves);
    }
  }
}

TEST(PassingCodec, GivesBackIntents) {
  const PassingIntent heard = told(intent());
  EXPECT_EQ(heard.agent, "ugv12");
  EXPECT_EQ(heard.epoch, 7U);
  EXPECT_EQ(heard.priority, -3);
  EXPECT_TRUE(heard.calls);
  EXPECT_DOUBLE_EQ(heard.radius_m, 0.333);
  EXPECT_EQ(heard.goal.value(), Vector2(12.34567, -4.2));
  EXPECT_EQ(heard.follows, (PassingOrderId{"ugv3", 2, 9}));
  EXPECT_EQ(heard.moves, 14U);
  EXPECT_LE(encoded(intent()).size(), 64U);
}

TEST(PassingCodec, GivesBackThatARobotIsParkedAndFollowsNobody) {
  PassingIntent parked = intent();
  parked.calls = false;
  parked.goal.reset();
  parked.follows = {};
  const PassingIntent heard = told(parked);
  EXPECT_FALSE(heard.calls);
  EXPECT_FALSE(heard.goal);
  EXPECT_EQ(heard.follows, PassingOrderId());
}

TEST(PassingCodec, GivesBackObstacles) {
  PassingIntent obstructed = intent();
  for (std::size_t i = 0; i < kMostObstacles; ++i)
    obstructed.obstacles.emplace_back(12.0 + 0.1 * static_cast<double>(i), -4.5);
  EXPECT_EQ(told(obstructed).obstacles, obstructed.obstacles);
  EXPECT_LE(encoded(obstructed).size(), 160U);
  obstructed.goal.reset();
  EXPECT_EQ(told(obstructed).obstacles, obstructed.obstacles);
}

TEST(PassingCodec, ARobotIsNotToldToBeSmallerThanItIs) {
  PassingIntent wide = intent();
  wide.radius_m = 0.33301;
  EXPECT_DOUBLE_EQ(told(wide).radius_m, 0.334);
}

TEST(PassingCodec, GivesBackInstructionsAsTheirLeaderKeepsToThem) {
  for (const Vector2& origin : {Vector2(3.0, -7.0), Vector2(567890.12, 5432109.87)}) {
    const PassingInstruction sent = instruction(20, origin);
    const PassingInstruction kept = quantised(sent);
    expect_same(told(sent), kept);
    expect_same(quantised(kept), kept);
    EXPECT_EQ(encoded(kept), encoded(sent));
    for (std::size_t i = 0; i < sent.part.size(); ++i) {
      for (std::size_t k = 0; k < sent.part[i].path.size(); ++k)
        EXPECT_LT((kept.part[i].path[k] - sent.part[i].path[k]).norm(), 1e-5);
    }
  }
}

TEST(PassingCodec, TwentyTurnsTakeAThirdOfADatagram) {
  EXPECT_LE(encoded(instruction(20)).size(), 470U);
  PassingInstruction straight = instruction(20);
  for (PassingTurn& turn : straight.part) turn.path.erase(turn.path.begin() + 1);
  EXPECT_LE(encoded(straight).size(), 390U);
}

TEST(PassingCodec, WhatIsTooLongIsSaidInPartsThatFit) {
  const PassingInstruction whole = instruction(kMostTurns);
  EXPECT_FALSE(fits(whole));
  EXPECT_THROW(encoded(whole), std::invalid_argument);
  PassingInstruction joined = whole;
  joined.part.clear();
  int parts = 0;
  for (std::uint32_t first = 0; first < whole.turns; ++parts) {
    const PassingInstruction part = fitting_part(whole, first);
    const PassingInstruction heard = told(part);
    EXPECT_EQ(heard.first, first);
    EXPECT_EQ(heard.turns, whole.turns);
    joined.part.insert(joined.part.end(), heard.part.begin(), heard.part.end());
    first += static_cast<std::uint32_t>(heard.part.size());
    PassingInstruction more = part;
    if (first == whole.turns) break;
    more.part.push_back(whole.part[first]);
    EXPECT_FALSE(fits(more)) << first;
  }
  expect_same(joined, quantised(whole));
  EXPECT_LE(parts, 7);
}

TEST(PassingCodec, APartMayBeTakenOfAPart) {
  const PassingInstruction whole = instruction(10);
  EXPECT_EQ(fitting_part(whole, 0).part.size(), 10U);
  const PassingInstruction rest = fitting_part(whole, 4);
  EXPECT_EQ(rest.part.size(), 6U);
  expect_same(fitting_part(rest, 7), fitting_part(whole, 7));
  EXPECT_TRUE(fitting_part(rest, 10).part.empty());
  EXPECT_THROW(fitting_part(rest, 3), std::invalid_argument);
  EXPECT_THROW(fitting_part(rest, 11), std::invalid_argument);
}

TEST(PassingCodec, TheNamesOfAWholeGroupLeaveRoomUnlessTheyAreVeryLong) {
  PassingInstruction whole = instruction(30);
  const auto name_all = [&](std::size_t letters) {
    whole.robots.clear();
    for (std::size_t i = 10; i < 10 + kMostPassing; ++i)
      whole.robots.push_back(std::string(letters - 2, 'x') + std::to_string(i));
    whole.robot = whole.robots.back();
    whole.id.leader = whole.robots.front();
  };
  name_all(20);
  EXPECT_GE(fitting_part(whole, 0).part.size(), 20U);
  name_all(63);
  EXPECT_TRUE(fitting_part(whole, 0).part.empty());
}

TEST(PassingCodec, RefusesWhatCannotBeSaid) {
  PassingInstruction bad = instruction(3);
  bad.part[1].path[1].x() = 1e12;
  EXPECT_THROW(encoded(bad), std::invalid_argument);
  EXPECT_THROW(quantised(bad), std::invalid_argument);
  bad = instruction(3);
  bad.robots[5] = "two words";
  EXPECT_THROW(encoded(bad), std::invalid_argument);
  bad = instruction(3);
  bad.part[0].after[0].robot = 200;
  EXPECT_THROW(encoded(bad), std::invalid_argument);
  PassingIntent wide = intent();
  wide.radius_m = 10.1;
  EXPECT_THROW(encoded(wide), std::invalid_argument);
  wide = intent();
  wide.goal->y() = -1e12;
  EXPECT_THROW(encoded(wide), std::invalid_argument);
  PassingIntent obstructed = intent();
  obstructed.obstacles = {Vector2(0.0, 1e12)};
  EXPECT_THROW(encoded(obstructed), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
