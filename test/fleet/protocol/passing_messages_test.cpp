#include "fleet/protocol/passing_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace mocha {
namespace {

PassingIntent intent() {
  PassingIntent intent{"ugv2", 3, 1, true, 0.3, Vector2(1.0, 2.0), {"ugv1", 4, 5}, 6};
  return intent;
}

/// What the second of three robots is to do, from its third turn on.
PassingInstruction instruction() {
  return {{"ugv1", 4, 5},
          "ugv2",
          {"ugv1", "ugv2", "ugv3"},
          4,
          3,
          2,
          {{{{0.0, 0.0}, {1.0, 0.0}}, {{0, 3}, {2, 1}}}, {{{1.0, 0.0}, {1.0, 1.0}}, {}}}};
}

template <typename Message>
void expect_refused(const Message& bad, const char* why) {
  try {
    validate(bad);
    ADD_FAILURE() << "is taken, though it " << why;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

/// The message with one thing changed.
template <typename Message, typename Change>
Message with(Message message, Change change) {
  change(message);
  return message;
}

TEST(PassingMessages, ThePriorityGoesBeforeTheName) {
  const auto of = [](int priority, const char* agent) {
    PassingIntent intent;
    intent.priority = priority;
    intent.agent = agent;
    return intent;
  };
  const std::vector<PassingIntent> ranks = {of(9, "ugv9"), of(0, "ugv1"), of(0, "ugv2"),
                                            of(-1, "ugv0")};
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    for (std::size_t k = 0; k < ranks.size(); ++k)
      EXPECT_EQ(outranks(ranks[i], ranks[k]), i < k) << i << " " << k;
  }
}

TEST(PassingMessages, AnOrderIsThatOfItsLeaderAndNumber) {
  const PassingOrderId id{"ugv1", 4, 5};
  EXPECT_EQ(id, (PassingOrderId{"ugv1", 4, 5}));
  EXPECT_EQ(id, (PassingOrderId{"ugv1", 0, 5}));  // as who follows it says
  EXPECT_NE(id, (PassingOrderId{"ugv2", 4, 5}));
  EXPECT_NE(id, (PassingOrderId{"ugv1", 4, 6}));
}

TEST(PassingMessages, RefuseIntentsThatNoRobotCanHave) {
  using Intent = PassingIntent;
  EXPECT_NO_THROW(validate(intent()));
  EXPECT_NO_THROW(validate(with(intent(), [](Intent& i) { i.goal.reset(); })));
  EXPECT_NO_THROW(validate(with(intent(), [](Intent& i) { i.follows = {}; })));
  expect_refused(with(intent(), [](Intent& i) { i.agent.clear(); }), "no name");
  for (const double radius_m : {0.0, -1.0, 11.0, std::nan("")})
    expect_refused(with(intent(), [&](Intent& i) { i.radius_m = radius_m; }), "radius");
  expect_refused(with(intent(), [](Intent& i) { i.goal->x() = std::nan(""); }), "not finite");
  expect_refused(with(intent(), [](Intent& i) { i.follows.leader.clear(); }), "nobody's order");
  expect_refused(with(intent(), [](Intent& i) { i.moves = kMostTurns + 1; }), "moves");
  const auto obstructed_by = [](std::size_t count, const Vector2& place) {
    return with(intent(), [&](Intent& i) { i.obstacles.assign(count, place); });
  };
  EXPECT_NO_THROW(validate(obstructed_by(kMostObstacles, {1.0, 2.0})));
  expect_refused(obstructed_by(kMostObstacles + 1, {1.0, 2.0}), "17 obstacles");
  expect_refused(obstructed_by(1, {1.0, std::nan("")}), "an obstacle is not finite");
}

TEST(PassingMessages, RefuseInstructionsThatAreNotOfTheirOrder) {
  using Instruction = PassingInstruction;
  EXPECT_NO_THROW(validate(instruction()));
  EXPECT_NO_THROW(validate(with(instruction(), [](Instruction& i) { i.part.clear(); })));
  expect_refused(with(instruction(), [](Instruction& i) { i.id.leader.clear(); }), "no name");
  expect_refused(with(instruction(), [](Instruction& i) { i.robots[2].clear(); }), "no name");
  expect_refused(with(instruction(), [](Instruction& i) { i.id.number = 0; }), "no number");
  expect_refused(with(instruction(), [](Instruction& i) { i.robot = "ugv4"; }), "not for");
  expect_refused(with(instruction(), [](Instruction& i) { i.robot.clear(); }), "not for");
  expect_refused(with(instruction(), [](Instruction& i) { i.robots[2] = "ugv1"; }), "twice");
  const auto more_robots = [](Instruction& i) {
    while (i.robots.size() <= kMostPassing) i.robots.push_back(std::to_string(i.robots.size()));
  };
  expect_refused(with(instruction(), more_robots), "33 robots");
  expect_refused(with(instruction(), [](Instruction& i) { i.turns = kMostTurns + 1; }), "turns");
  expect_refused(with(instruction(), [](Instruction& i) { i.turns = 3; }), "beyond the end");
  expect_refused(with(instruction(), [](Instruction& i) { i.alone_from = 5; }), "beyond its end");
  expect_refused(with(instruction(), [](Instruction& i) { i.first = 3; }), "beyond the end");
  expect_refused(with(instruction(), [](Instruction& i) { i.first = 4000000000U; }), "beyond");
}

TEST(PassingMessages, RefuseTurnsThatCannotBeMade) {
  const auto bad = [](const auto& change) {
    PassingInstruction message = instruction();
    change(message.part[0]);
    return message;
  };
  using Turn = PassingTurn;
  expect_refused(bad([](Turn& t) { t.path.pop_back(); }), "less than two places");
  expect_refused(bad([](Turn& t) { t.path.resize(kMostTurnPlaces + 1, {1.0, 1.0}); }), "9 places");
  expect_refused(bad([](Turn& t) { t.path[1].y() = std::numeric_limits<double>::infinity(); }),
                 "not finite");
  expect_refused(bad([](Turn& t) { t.after[0].robot = 3; }), "not there");
  expect_refused(bad([](Turn& t) { t.after[0].robot = 1; }), "itself");
  expect_refused(bad([](Turn& t) { t.after[0].robot = 2; }), "twice");
  expect_refused(bad([](Turn& t) { t.after[0].moves = kMostTurns + 1; }), "turns to wait for");
}

}  // namespace
}  // namespace mocha
