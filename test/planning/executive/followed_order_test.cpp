#include "planning/executive/followed_order.h"

#include <gtest/gtest.h>

#include <map>

#include "trajectory/simple_motions.h"

namespace mocha {
namespace {

/// What others have promised, by name.
using Promised = std::map<std::string, std::uint32_t>;

FollowedOrder::PromisedBy by(const Promised& promised) {
  return [promised](const std::string& name) {
    const auto found = promised.find(name);
    return found != promised.end() ? found->second : 0;
  };
}

PassingTurn turn(const Vector2& from, const Vector2& to, std::vector<PassingProgress> after = {}) {
  return {{from, to}, std::move(after)};
}

PassingInstruction part(std::uint32_t turns, std::uint32_t first, std::vector<PassingTurn> part) {
  return {{"ugv1", 1, 7}, "ugv2", {"ugv1", "ugv2", "ugv3"}, turns, turns, first, std::move(part)};
}

/// One metre along x, the same again, and then one along y.
PassingInstruction bend() {
  return part(
      3, 0,
      {turn({0.0, 0.0}, {1.0, 0.0}), turn({1.0, 0.0}, {2.0, 0.0}), turn({2.0, 0.0}, {2.0, 1.0})});
}

/// Into a siding and out again.
PassingInstruction siding() {
  return part(
      3, 0,
      {turn({0.0, 0.0}, {1.0, 0.0}), turn({1.0, 0.0}, {1.0, 1.0}), turn({1.0, 1.0}, {1.0, -1.0})});
}

Motion to_rest_at(const Vector2& place) { return standing(0.0, place, 0.0); }

TEST(FollowedOrder, GrantsAllMovesThatWaitForNobodyAsOneStretch) {
  FollowedOrder order(bend());
  EXPECT_EQ(order.start(), Vector2(0.0, 0.0));
  const auto stretch = order.grant(by({}));
  ASSERT_TRUE(stretch);
  EXPECT_EQ(stretch->from, 0u);
  EXPECT_EQ(stretch->until, 3u);
  const std::vector<Vector2> path = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}};
  EXPECT_EQ(stretch->path, path);
  EXPECT_EQ(stretch->end(), Vector2(2.0, 1.0));
}

TEST(FollowedOrder, AMoveWaitsForEachPromiseThatItIsToWaitFor) {
  PassingInstruction instruction = bend();
  instruction.part[1].after = {{0, 2}, {2, 1}};
  FollowedOrder order(instruction);
  for (const Promised& promised :
       {Promised(), Promised{{"ugv1", 2}}, Promised{{"ugv1", 1}, {"ugv3", 1}}}) {
    const auto stretch = order.grant(by(promised));
    ASSERT_TRUE(stretch);
    EXPECT_EQ(stretch->until, 1u);
  }
  EXPECT_EQ(order.grant(by({{"ugv1", 3}, {"ugv3", 1}}))->until, 3u);
}

TEST(FollowedOrder, NothingIsGrantedBeforeItsFirstTurn) {
  PassingInstruction instruction = bend();
  instruction.part[0].after = {{0, 1}};
  FollowedOrder order(instruction);
  EXPECT_FALSE(order.grant(by({})));
  EXPECT_TRUE(order.grant(by({{"ugv1", 1}})));
}

/// A message that got lost, or a robot that left the order, takes nothing back.
TEST(FollowedOrder, WhatWasGrantedStays) {
  PassingInstruction instruction = bend();
  instruction.part[0].after = {{0, 1}};
  FollowedOrder order(instruction);
  order.grant(by({{"ugv1", 1}}));
  ASSERT_TRUE(order.grant(by({})));
  EXPECT_EQ(order.grant(by({}))->until, 3u);
}

TEST(FollowedOrder, WhatItHasNotBeenToldOfYetIsNotGranted) {
  FollowedOrder order(part(3, 0, {turn({0.0, 0.0}, {1.0, 0.0})}));
  EXPECT_EQ(order.grant(by({}))->until, 1u);
  EXPECT_FALSE(order.is_over());
  order.add(part(3, 2, {turn({2.0, 0.0}, {2.0, 1.0})}));
  EXPECT_EQ(order.grant(by({}))->until, 1u) << "there is a gap";
  order.add(part(3, 1, {turn({1.0, 0.0}, {2.0, 0.0})}));
  EXPECT_EQ(order.grant(by({}))->until, 3u);
}

TEST(FollowedOrder, AnOrderOfWhichTheBeginningIsNotThereHasNoStart) {
  EXPECT_FALSE(FollowedOrder(part(3, 0, {})).start());
  EXPECT_FALSE(FollowedOrder(part(3, 1, {turn({1.0, 0.0}, {2.0, 0.0})})).start());
  FollowedOrder order(part(3, 0, {}));
  EXPECT_FALSE(order.grant(by({})));
}

TEST(FollowedOrder, APartThatIsNotOfThisOrderChangesNothing) {
  FollowedOrder order(part(2, 0, {turn({0.0, 0.0}, {1.0, 0.0})}));
  PassingInstruction odd = part(2, 1, {turn({1.0, 0.0}, {2.0, 0.0}, {{3, 1}})});
  odd.robots.push_back("ugv4");
  order.add(odd);
  order.add(part(5, 1, {turn({1.0, 0.0}, {2.0, 0.0}), turn({2.0, 0.0}, {3.0, 0.0})}));
  EXPECT_EQ(order.grant(by({}))->until, 1u);
}

TEST(FollowedOrder, AStretchEndsWhereTheWayTurnsBack) {
  FollowedOrder order(siding());
  const auto in = order.grant(by({}));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->until, 2u) << "square bends are driven through";
  EXPECT_EQ(in->end(), Vector2(1.0, 1.0));
}

TEST(FollowedOrder, ThatItIsToTurnBackCanBePromisedBeforeTheRobotIsThere) {
  FollowedOrder order(siding());
  order.grant(by({}));
  order.note_promise(to_rest_at({1.0, 0.5}));
  EXPECT_EQ(order.grant(by({}))->until, 2u) << "it has not promised to get there";
  order.note_promise(to_rest_at({1.0, 1.0}));
  const auto back = order.grant(by({}));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->from, 2u);
  EXPECT_EQ(back->until, 3u);
  EXPECT_EQ(back->path.front(), Vector2(1.0, 1.0));
}

/// Until then, a quicker way there can be promised.
TEST(FollowedOrder, WhereItTurnsBackIsNoStopBeforeItMayGoOnOrStandsThere) {
  PassingInstruction instruction = siding();
  instruction.part[2].after = {{0, 1}};
  FollowedOrder order(instruction);
  order.grant(by({}));
  order.note_promise(to_rest_at({1.0, 1.0}));
  const auto in = order.grant(by({}));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->from, 0u);
  EXPECT_EQ(in->until, 2u);
  FollowedOrder stands = order;
  EXPECT_EQ(order.grant(by({{"ugv1", 1}}))->from, 2u);
  stands.note_stand({1.0, 1.0}, 0.15);
  EXPECT_FALSE(stands.grant(by({})));
  EXPECT_EQ(stands.grant(by({{"ugv1", 1}}))->from, 2u);
}

/// Round a block, and on through the place where it began.
TEST(FollowedOrder, AStretchEndsBeforeItComesToWhereItHasLed) {
  const std::vector<Vector2> round = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0},
                                      {2.0, 2.0}, {0.0, 2.0}, {0.0, -2.0}};
  const std::vector<Vector2> across = {{0.0, 0.0}, {2.0, 0.0},  {2.0, 2.0},
                                       {1.0, 2.0}, {1.0, -2.0}, {0.0, -2.0}};
  for (const auto& places : {round, across}) {
    std::vector<PassingTurn> turns;
    for (std::size_t i = 1; i < places.size(); ++i) turns.push_back(turn(places[i - 1], places[i]));
    FollowedOrder order(part(5, 0, turns));
    const auto there = order.grant(by({}));
    ASSERT_TRUE(there);
    ASSERT_LT(there->until, 5u);
    EXPECT_EQ(there->end().y(), 2.0);
    order.note_promise(to_rest_at(places[there->until]));
    EXPECT_EQ(order.promised(), there->until);
    const auto on = order.grant(by({}));
    ASSERT_TRUE(on) << "before the robot is there";
    EXPECT_EQ(on->from, there->until);
    EXPECT_EQ(on->until, 5u);
    order.note_promise(to_rest_at(places.back()));
    EXPECT_EQ(order.promised(), 5u) << "though its end is near the beginning";
  }
}

TEST(FollowedOrder, PromisedIsWhatTheMotionInForceLeadsThrough) {
  FollowedOrder order(bend());
  order.grant(by({}));
  order.note_promise(to_rest_at({0.0, 0.0}));
  EXPECT_EQ(order.promised(), 0u);
  order.note_promise(to_rest_at({0.8, 0.0}));
  EXPECT_EQ(order.promised(), 0u);
  order.note_promise(to_rest_at({1.4, 0.1}));
  EXPECT_EQ(order.promised(), 1u);
  order.note_promise(to_rest_at({2.0, 0.5}));
  EXPECT_EQ(order.promised(), 2u);
  order.note_promise(to_rest_at({2.0, 0.9}));
  EXPECT_EQ(order.promised(), 2u) << "not all the way";
  order.note_promise(to_rest_at({2.0, 0.98}));
  EXPECT_EQ(order.promised(), 3u);
  EXPECT_FALSE(order.is_over()) << "it is on its way";
}

TEST(FollowedOrder, WhatIsPromisedStaysSo) {
  FollowedOrder order(bend());
  order.grant(by({}));
  order.note_promise(to_rest_at({2.0, 0.0}));
  order.note_promise(to_rest_at({1.2, 0.0}));
  EXPECT_EQ(order.promised(), 2u);
}

TEST(FollowedOrder, AMotionThatLeadsElsewhereIsNotOfTheOrder) {
  FollowedOrder order(bend());
  order.grant(by({}));
  order.note_promise(to_rest_at({1.5, -0.6}));
  order.note_promise(to_rest_at({2.0, 1.7}));
  order.note_promise(Motion());
  EXPECT_EQ(order.promised(), 0u);
}

TEST(FollowedOrder, WhatWasNotGrantedIsNotPromised) {
  PassingInstruction instruction = bend();
  instruction.part[1].after = {{0, 1}};
  FollowedOrder order(instruction);
  order.note_promise(to_rest_at({2.0, 0.0}));
  EXPECT_EQ(order.promised(), 0u);
  order.grant(by({}));
  order.note_promise(to_rest_at({1.2, 0.0}));
  EXPECT_EQ(order.promised(), 1u);
}

TEST(FollowedOrder, MadeIsWhereTheRobotStandsAtTheEndOfAMoveThatItPromised) {
  FollowedOrder order(bend());
  order.grant(by({}));
  order.note_stand({1.0, 0.0}, 0.15);
  EXPECT_EQ(order.grant(by({}))->from, 0u) << "not promised";
  order.note_promise(to_rest_at({2.0, 1.0}));
  order.note_stand({1.5, 0.0}, 0.15);
  EXPECT_EQ(order.grant(by({}))->from, 0u) << "between two places";
  order.note_stand({2.1, 0.0}, 0.15);
  const auto rest = order.grant(by({}));
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->from, 2u);
  EXPECT_EQ(rest->path.front(), Vector2(2.0, 0.0));
  EXPECT_FALSE(order.is_over());
  order.note_stand({2.0, 0.9}, 0.15);
  EXPECT_TRUE(order.is_over());
  EXPECT_FALSE(order.grant(by({})));
}

/// Others wait for its second move, or it for theirs; the third is its own affair.
TEST(FollowedOrder, ItIsOverOnceTheRobotDrivesByTheEndOfTheLastMoveThatOthersHaveToDoWith) {
  PassingInstruction instruction = bend();
  instruction.alone_from = 2;
  FollowedOrder order(instruction);
  order.grant(by({}));
  order.note_drive({2.0, 0.2});
  EXPECT_FALSE(order.is_over()) << "not promised";
  order.note_promise(to_rest_at({2.0, 1.0}));
  order.note_drive({1.5, 0.0});
  EXPECT_FALSE(order.is_over()) << "not by there yet";
  order.note_drive({2.0, 0.1});
  EXPECT_TRUE(order.is_over());
  EXPECT_EQ(order.moves(), 3U);
}

TEST(FollowedOrder, ItIsNotOverWhereTheRobotDrivesByOnlyUpToThere) {
  PassingInstruction instruction = bend();
  instruction.alone_from = 2;
  FollowedOrder order(instruction);
  order.grant(by({}));
  order.note_promise(to_rest_at({1.5, 0.0}));
  order.note_drive({1.5, 0.0});
  EXPECT_FALSE(order.is_over());
}

TEST(FollowedOrder, ItIsOverAtOnceForWhoHasNothingToDoWithOthers) {
  PassingInstruction instruction = bend();
  instruction.alone_from = 0;
  EXPECT_TRUE(FollowedOrder(instruction).is_over());
}

TEST(FollowedOrder, WithoutMovesItIsOverAtOnce) {
  FollowedOrder order(part(0, 0, {}));
  EXPECT_TRUE(order.is_over());
  EXPECT_FALSE(order.start());
  EXPECT_FALSE(order.grant(by({})));
}

}  // namespace
}  // namespace mocha
