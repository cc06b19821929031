#include "planning/passing/passing_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planning/passing/cell_world.h"

namespace mocha {
namespace {

int number_of(const PlaceGraph& graph, const Vector2& place) {
  for (int i = 0; i < graph.size(); ++i) {
    if ((graph.places[i] - place).norm() < 1e-9) return i;
  }
  return -1;
}

const PlaceMove& move_of(const PlaceGraph& graph, int from, const std::vector<Vector2>& path) {
  const int to = number_of(graph, path.back());
  return *std::find_if(graph.moves[from].begin(), graph.moves[from].end(),
                       [&](const PlaceMove& move) { return move.to == to; });
}

bool may_begin(const PassingTurn& turn, const std::vector<int>& made) {
  return std::all_of(turn.after.begin(), turn.after.end(), [&](const PassingProgress& progress) {
    return made[progress.robot] >= static_cast<int>(progress.moves);
  });
}

/// Makes the moves one by one, whichever the order allows, drawn by lot.
void drive(const PassingProblem& problem, const PassingOrder& order, int seed) {
  std::mt19937 random(seed);
  const int robots = static_cast<int>(problem.starts.size());
  Placing placing = problem.starts;
  std::vector<int> made(robots, 0);
  for (;;) {
    std::vector<int> next;
    bool is_over = true;
    for (int robot = 0; robot < robots; ++robot) {
      if (made[robot] == static_cast<int>(order[robot].size())) continue;
      is_over = false;
      if (may_begin(order[robot][made[robot]], made)) next.push_back(robot);
    }
    if (is_over) break;
    ASSERT_FALSE(next.empty()) << "nobody may move";
    const int robot = next[random() % next.size()];
    const PlaceMove& move = move_of(problem.graph, placing[robot], order[robot][made[robot]].path);
    for (int other = 0; other < robots; ++other) {
      if (other == robot) continue;
      ASSERT_FALSE(move.blocked_by.contains(placing[other]));
    }
    placing[robot] = move.to;
    ++made[robot];
  }
  EXPECT_EQ(placing, problem.goals);
}

TEST(PassingOrder, LeadsToTheGoalsInWhateverOrderItAllows) {
  int waits = 0;
  for (const auto& puzzle : test::puzzles()) {
    const PassingProblem problem = test::in_space(puzzle);
    const PassingSequence sequence = test::solved(problem);
    if (sequence.outcome != PassingSequence::Outcome::kFound) continue;
    const PassingOrder order = order_of(sequence.steps, static_cast<int>(problem.starts.size()));
    for (int seed = 0; seed < 50; ++seed) drive(problem, order, seed);
    for (const auto& turns : order) {
      for (const PassingTurn& turn : turns) waits += static_cast<int>(turn.after.size());
    }
  }
  EXPECT_GT(waits, 50);
}

/// Whether the moves, or where they end, are in the way of each other.
bool meet(const PlaceMove& a, const PlaceMove& b) {
  return a.blocked_by.contains(b.to) || b.blocked_by.contains(a.to);
}

TEST(PassingOrder, WhatARobotDrivesAloneMeetsNoMoveOfOthers) {
  std::uint32_t alone = 0;
  auto puzzles = test::puzzles();
  puzzles.push_back(
      {"arms",
       {"###b###", "###.###", "###.###", "a......", "###.###", "###.###", "###.###"},
       {"###.###", "###.###", "###.###", "......a", "###.###", "###.###", "###b###"}});
  for (const auto& puzzle : puzzles) {
    const PassingProblem problem = test::in_space(puzzle);
    const PassingSequence sequence = test::solved(problem);
    if (sequence.outcome != PassingSequence::Outcome::kFound) continue;
    const int robots = static_cast<int>(problem.starts.size());
    const PassingOrder order = order_of(sequence.steps, robots);
    const std::vector<std::uint32_t> from = alone_from(order);
    std::vector<std::vector<PlaceMove>> moves(robots);
    for (int robot = 0; robot < robots; ++robot) {
      ASSERT_LE(from[robot], order[robot].size());
      int place = problem.starts[robot];
      for (const PassingTurn& turn : order[robot]) {
        moves[robot].push_back(move_of(problem.graph, place, turn.path));
        place = moves[robot].back().to;
      }
    }
    for (int robot = 0; robot < robots; ++robot) {
      for (std::uint32_t i = from[robot]; i < moves[robot].size(); ++i, ++alone) {
        EXPECT_TRUE(order[robot][i].after.empty());
        for (int other = 0; other < robots; ++other) {
          if (other == robot) continue;
          for (const PlaceMove& move : moves[other])
            EXPECT_FALSE(meet(moves[robot][i], move)) << puzzle.name;
        }
      }
    }
  }
  EXPECT_GE(alone, 3U);
}

TEST(PassingOrder, ARobotIsAloneOnceItWaitsForNobodyNorAnybodyForIt) {
  const PassingTurn free{{{0.0, 0.0}, {1.0, 0.0}}, {}};
  PassingTurn second = free;
  second.after = {{1, 2}};
  const std::vector<std::uint32_t> two_wait = {2, 2, 0};
  EXPECT_EQ(alone_from({{free, second, free}, {free, free, free}, {free}}), two_wait);
  EXPECT_TRUE(alone_from({}).empty());
}

TEST(PassingOrder, RobotsThatDoNotMeetDoNotWait) {
  const PassingProblem problem =
      test::in_space({"apart", {"a..", "###", "b.."}, {"..a", "###", "..b"}});
  const PassingOrder order = order_of(test::solved(problem).steps, 2);
  for (const auto& turns : order) {
    EXPECT_GE(turns.size(), 2u);
    for (const PassingTurn& turn : turns) EXPECT_TRUE(turn.after.empty());
  }
}

}  // namespace
}  // namespace mocha
