#include "planning/passing/joint_step.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mocha {
namespace {

/// A ring of places, each a metre from the next, on which only ends block.
PlaceGraph ring(int count) {
  PlaceGraph graph;
  graph.places.assign(count, Vector2::Zero());
  graph.moves.resize(count);
  for (int place = 0; place < count; ++place) {
    for (const int to : {(place + 1) % count, (place + count - 1) % count})
      graph.moves[place].push_back({to, 1.0, {}, {to}});
  }
  return graph;
}

const PlaceMove* onward(const PlaceGraph& graph, int place) { return &graph.moves[place][0]; }
const PlaceMove* backward(const PlaceGraph& graph, int place) { return &graph.moves[place][1]; }

TEST(JointStep, RobotsFollowEachOther) {
  const PlaceGraph graph = ring(5);
  JointStep step(graph, {0, 1, 2});
  EXPECT_TRUE(step.choose(0, onward(graph, 0)));
  EXPECT_TRUE(step.choose(1, onward(graph, 1)));
  EXPECT_TRUE(step.choose(2, onward(graph, 2)));
  EXPECT_EQ(step.order(), (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(step.placing(), (Placing{1, 2, 3}));
}

TEST(JointStep, NobodyEntersAPlaceThatIsNotLeft) {
  const PlaceGraph graph = ring(5);
  JointStep step(graph, {0, 1});
  EXPECT_TRUE(step.choose(1, nullptr));
  EXPECT_FALSE(step.choose(0, onward(graph, 0)));
  EXPECT_FALSE(step.is_chosen(0));
  EXPECT_EQ(step.to(0), 0);
  EXPECT_TRUE(step.choose(0, backward(graph, 0)));
}

TEST(JointStep, NeighboursDoNotSwap) {
  const PlaceGraph graph = ring(5);
  JointStep step(graph, {0, 1});
  EXPECT_TRUE(step.choose(0, onward(graph, 0)));
  EXPECT_FALSE(step.choose(1, backward(graph, 1)));
}

TEST(JointStep, AFullRingDoesNotTurn) {
  const PlaceGraph graph = ring(4);
  JointStep step(graph, {0, 1, 2, 3});
  for (const int robot : {0, 1, 2}) EXPECT_TRUE(step.choose(robot, onward(graph, robot)));
  EXPECT_FALSE(step.choose(3, onward(graph, 3)));
  EXPECT_FALSE(step.choose(3, nullptr));  // robot 2 is to come here
}

TEST(JointStep, TwoDoNotMeetAtOnePlace) {
  const PlaceGraph graph = ring(5);
  JointStep step(graph, {0, 2});
  EXPECT_TRUE(step.choose(0, onward(graph, 0)));
  EXPECT_FALSE(step.choose(1, backward(graph, 2)));
}

TEST(JointStep, WhoPassesAPlaceGoesBeforeWhoStopsThere) {
  PlaceGraph graph = ring(6);
  graph.moves[0][0].blocked_by = {1, 4};  // from 0 to 1 it passes 4 closely
  JointStep step(graph, {0, 3});
  EXPECT_TRUE(step.choose(1, onward(graph, 3)));  // to 4
  EXPECT_TRUE(step.choose(0, onward(graph, 0)));
  EXPECT_EQ(step.order(), (std::vector<int>{0, 1}));
  EXPECT_EQ(step.in_the_way(0, graph.moves[0][0]), (std::vector<int>{}));
  EXPECT_EQ(JointStep(graph, {0, 4}).in_the_way(0, graph.moves[0][0]), (std::vector<int>{1}));
}

TEST(JointStep, RefusesMoreRobotsThanItCanTell) {
  const PlaceGraph graph = ring(40);
  EXPECT_NO_THROW(JointStep(graph, Placing(JointStep::kMostRobots, 0)));
  EXPECT_THROW(JointStep(graph, Placing(JointStep::kMostRobots + 1, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
