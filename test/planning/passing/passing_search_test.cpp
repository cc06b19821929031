#include "planning/passing/passing_search.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "planning/passing/cell_world.h"
#include "planning/passing/solvability.h"

namespace mocha {
namespace {

using Outcome = PassingSequence::Outcome;

TEST(PassingSearch, SolvesThePuzzlesThatCanBeSolved) {
  int solved = 0;
  for (const auto& puzzle : test::puzzles()) {
    for (const PassingProblem& problem : {test::on_cells(puzzle), test::in_space(puzzle)}) {
      const PassingSequence sequence = test::solved(problem);
      EXPECT_EQ(sequence.outcome,
                test::can_be_solved(problem) ? Outcome::kFound : Outcome::kImpossible)
          << puzzle.name;
      if (sequence.outcome != Outcome::kFound) continue;
      ++solved;
      test::expect_valid(problem, sequence.steps);
    }
  }
  EXPECT_GE(solved, 8);
}

TEST(PassingSearch, FindsASequenceIfAndOnlyIfThereIsOne) {
  int solved = 0;
  int impossible = 0;
  for (int seed = 0; seed < 600; ++seed) {
    const PassingProblem problem = test::random_problem(seed);
    const PassingSequence sequence = test::solved(problem);
    if (test::can_be_solved(problem)) {
      ++solved;
      EXPECT_EQ(sequence.outcome, Outcome::kFound) << seed;
      test::expect_valid(problem, sequence.steps);
    } else {
      ++impossible;
      EXPECT_EQ(sequence.outcome, Outcome::kImpossible) << seed;
    }
  }
  EXPECT_GT(solved, 200);
  EXPECT_GT(impossible, 50);
}

TEST(PassingSearch, WhoHasNoGoalMakesRoom) {
  PassingProblem problem = test::on_cells({"side", {"ab..", "#.##"}, {"..a.", "#.##"}});
  problem.goals.push_back(PassingProblem::kAnywhere);
  const PassingSequence sequence = test::solved(problem);
  ASSERT_EQ(sequence.outcome, Outcome::kFound);
  test::expect_valid(problem, sequence.steps);
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
}

}  // namespace
}  // namespace mocha
