#include "planning/passing/passing_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <queue>
#include <random>
#include <set>
#include <stdexcept>

#include "planning/passing/cell_world.h"
#include "planning/passing/step_search.h"

namespace mocha {
namespace {

using Outcome = PassingSequence::Outcome;

bool is_free(const PlaceMove& move, const Placing& placing, int robot) {
  for (int other = 0; other < static_cast<int>(placing.size()); ++other) {
    if (other == robot) continue;
    if (std::binary_search(move.blocked_by.begin(), move.blocked_by.end(), placing[other]))
      return false;
  }
  return true;
}

bool is_solved(const PassingProblem& problem, const Placing& placing) {
  for (std::size_t robot = 0; robot < placing.size(); ++robot) {
    if (problem.goals[robot] != PassingProblem::kAnywhere && problem.goals[robot] != placing[robot])
      return false;
  }
  return true;
}

/// Looks at all that can be reached by moves one by one.
bool can_be_solved(const PassingProblem& problem) {
  std::set<Placing> known = {problem.starts};
  std::queue<Placing> queue;
  queue.push(problem.starts);
  while (!queue.empty()) {
    const Placing placing = queue.front();
    queue.pop();
    if (is_solved(problem, placing)) return true;
    for (int robot = 0; robot < static_cast<int>(placing.size()); ++robot) {
      for (const PlaceMove& move : problem.graph.moves[placing[robot]]) {
        if (!is_free(move, placing, robot)) continue;
        Placing next = placing;
        next[robot] = move.to;
        if (known.insert(next).second) queue.push(next);
      }
    }
  }
  return false;
}

/// Drives the sequence move by move.
void expect_valid(const PassingProblem& problem, const PassingSequence& sequence) {
  Placing placing = problem.starts;
  for (const JointStep& step : sequence.steps) {
    for (const int robot : step.order()) {
      ASSERT_EQ(step.from(robot), placing[robot]);
      ASSERT_TRUE(is_free(*step.move(robot), placing, robot));
      placing[robot] = step.to(robot);
    }
    EXPECT_EQ(step.placing(), placing);
  }
  EXPECT_TRUE(is_solved(problem, placing));
}

TEST(PassingSearch, SolvesThePuzzlesThatCanBeSolved) {
  int solved = 0;
  for (const auto& puzzle : test::puzzles()) {
    for (const PassingProblem& problem : {test::on_cells(puzzle), test::in_space(puzzle)}) {
      const PassingSequence sequence = test::solved(problem);
      EXPECT_EQ(sequence.outcome, can_be_solved(problem) ? Outcome::kFound : Outcome::kImpossible)
          << puzzle.name;
      if (sequence.outcome != Outcome::kFound) continue;
      ++solved;
      expect_valid(problem, sequence);
    }
  }
  EXPECT_GE(solved, 8);
}

/// Random trees with a few more edges, and robots on most of their places.
PassingProblem random_problem(int seed) {
  std::mt19937 random(seed);
  const int places = 5 + seed % 4;
  const int robots = 2 + seed % 3;
  PassingProblem problem;
  problem.graph.places.assign(places, Vector2::Zero());
  problem.graph.moves.resize(places);
  std::vector<std::vector<int>> neighbours(places);
  const auto join = [&](int a, int b) {
    if (a == b || std::count(neighbours[a].begin(), neighbours[a].end(), b) > 0) return;
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  };
  for (int place = 1; place < places; ++place) join(place, static_cast<int>(random() % place));
  for (int more = 0; more < seed % 3; ++more) join(random() % places, random() % places);
  for (int place = 0; place < places; ++place) {
    for (const int to : neighbours[place]) {
      std::vector<int> blocked_by = {to};
      const int passed = static_cast<int>(random() % places);
      if (random() % 5 == 0 && passed != to && passed != place) blocked_by.push_back(passed);
      std::sort(blocked_by.begin(), blocked_by.end());
      problem.graph.moves[place].push_back({to, 1.0, {}, blocked_by});
    }
  }
  std::vector<int> from(places);
  for (int place = 0; place < places; ++place) from[place] = place;
  std::vector<int> to = from;
  std::shuffle(from.begin(), from.end(), random);
  std::shuffle(to.begin(), to.end(), random);
  problem.starts.assign(from.begin(), from.begin() + robots);
  problem.goals.assign(to.begin(), to.begin() + robots);
  if (seed % 5 == 0) problem.goals[0] = PassingProblem::kAnywhere;
  return problem;
}

TEST(PassingSearch, FindsASequenceIfAndOnlyIfThereIsOne) {
  int solved = 0;
  int impossible = 0;
  for (int seed = 0; seed < 600; ++seed) {
    const PassingProblem problem = random_problem(seed);
    const PassingSequence sequence = test::solved(problem);
    if (can_be_solved(problem)) {
      ++solved;
      EXPECT_EQ(sequence.outcome, Outcome::kFound) << seed;
      expect_valid(problem, sequence);
    } else {
      ++impossible;
      EXPECT_EQ(sequence.outcome, Outcome::kImpossible) << seed;
    }
  }
  EXPECT_GT(solved, 200);
  EXPECT_GT(impossible, 50);
}

TEST(PassingSearch, WhoHasNoGoalMakesRoomAndOnlyThen) {
  PassingProblem problem = test::on_cells({"side", {"ab..", "#.##"}, {"..a.", "#.##"}});
  problem.goals.push_back(PassingProblem::kAnywhere);
  const PassingSequence sequence = test::solved(problem);
  ASSERT_EQ(sequence.outcome, Outcome::kFound);
  expect_valid(problem, sequence);
  int moves = 0;
  for (const JointStep& step : sequence.steps) moves += step.move(1) != nullptr;
  EXPECT_EQ(moves, 1);
}

TEST(PassingSearch, FindsTheShortestWhereItIsEasy) {
  const auto problem = test::on_cells({"hall", {"a..", "...", "..b"}, {"b..", "...", "..a"}});
  const PassingSequence sequence = test::solved(problem);
  ASSERT_EQ(sequence.outcome, Outcome::kFound);
  EXPECT_EQ(sequence.steps.size(), 4u);
}

TEST(PassingSearch, StopsWhenItIsTold) {
  const auto problem = test::on_cells(test::puzzles()[0]);
  EXPECT_EQ(test::solved(problem, 1000000, [] { return true; }).outcome, Outcome::kStopped);
  EXPECT_EQ(test::solved(problem, 3).outcome, Outcome::kStopped);
}

TEST(PassingSearch, RefusesWhatIsNoProblem) {
  PassingProblem problem = test::on_cells(test::puzzles()[0]);
  problem.goals.pop_back();
  EXPECT_THROW(test::solved(problem), std::invalid_argument);
  problem = test::on_cells(test::puzzles()[0]);
  problem.starts[0] = problem.graph.size();
  EXPECT_THROW(test::solved(problem), std::invalid_argument);
  problem.starts[0] = PassingProblem::kAnywhere;
  EXPECT_THROW(test::solved(problem), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
