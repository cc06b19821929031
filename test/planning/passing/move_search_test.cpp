#include "planning/passing/move_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "planning/passing/cell_world.h"
#include "planning/passing/solvability.h"

namespace mocha {
namespace {

using Outcome = PassingSequence::Outcome;

constexpr int kEnough = 100000000;  // placings, for all that is asked here

void expect_one_by_one(const std::vector<JointStep>& steps) {
  for (const JointStep& step : steps) EXPECT_EQ(step.order().size(), 1u);
}

TEST(MoveSearch, SolvesThePuzzlesThatCanBeSolvedWithTheLeastDriving) {
  int solved = 0;
  for (const auto& puzzle : test::puzzles()) {
    for (const PassingProblem& problem : {test::on_cells(puzzle), test::in_space(puzzle)}) {
      const PassingSequence sequence = find_few_moves(problem, {kEnough});
      const double least_m = test::least_driving_m(problem);
      ASSERT_EQ(sequence.outcome, std::isfinite(least_m) ? Outcome::kFound : Outcome::kImpossible)
          << puzzle.name;
      if (sequence.outcome != Outcome::kFound) continue;
      ++solved;
      test::expect_valid(problem, sequence.steps);
      expect_one_by_one(sequence.steps);
      EXPECT_NEAR(test::driving_m(sequence.steps), least_m, 1e-6) << puzzle.name;
      EXPECT_LE(least_m, test::driving_m(test::solved(problem).steps) + 1e-6) << puzzle.name;
    }
  }
  EXPECT_GE(solved, 8);
}

TEST(MoveSearch, FindsTheLeastDrivingIfAndOnlyIfThereIsAWay) {
  int solved = 0;
  int impossible = 0;
  for (int seed = 0; seed < 600; ++seed) {
    const PassingProblem problem = test::random_problem(seed);
    const PassingSequence sequence = find_few_moves(problem, {kEnough});
    const double least_m = test::least_driving_m(problem);
    if (std::isfinite(least_m)) {
      ++solved;
      ASSERT_EQ(sequence.outcome, Outcome::kFound) << seed;
      test::expect_valid(problem, sequence.steps);
      expect_one_by_one(sequence.steps);
      EXPECT_NEAR(test::driving_m(sequence.steps), least_m, 1e-6) << seed;
    } else {
      ++impossible;
      EXPECT_EQ(sequence.outcome, Outcome::kImpossible) << seed;
      EXPECT_TRUE(sequence.steps.empty());
    }
  }
  EXPECT_GT(solved, 200);
  EXPECT_GT(impossible, 50);
}

TEST(MoveSearch, DrivesNoMoreThanOtherSequences) {
  double least_m = 0.0;
  double some_m = 0.0;
  for (int seed = 0; seed < 200; ++seed) {
    const PassingProblem problem = test::random_problem(seed);
    const PassingSequence some = test::solved(problem);
    if (some.outcome != Outcome::kFound) continue;
    const PassingSequence least = find_few_moves(problem, {kEnough});
    EXPECT_LE(test::driving_m(least.steps), test::driving_m(some.steps) + 1e-6) << seed;
    least_m += test::driving_m(least.steps);
    some_m += test::driving_m(some.steps);
  }
  EXPECT_LT(least_m, some_m);
}

TEST(MoveSearch, WhoIsAtItsGoalNeedNotMove) {
  const PassingProblem problem = test::on_cells({"there", {"a.b"}, {"a.b"}});
  const PassingSequence sequence = find_few_moves(problem, {0});
  EXPECT_EQ(sequence.outcome, Outcome::kFound);
  EXPECT_TRUE(sequence.steps.empty());
}

TEST(MoveSearch, WhoHasNoGoalMakesRoomAndNoMore) {
  PassingProblem problem = test::on_cells({"side", {"ab..", "#.##"}, {"..a.", "#.##"}});
  problem.goals.push_back(PassingProblem::kAnywhere);
  const PassingSequence sequence = find_few_moves(problem, {kEnough});
  ASSERT_EQ(sequence.outcome, Outcome::kFound);
  test::expect_valid(problem, sequence.steps);
  int moves = 0;
  for (const JointStep& step : sequence.steps) moves += step.move(1) != nullptr;
  EXPECT_EQ(moves, 1);
}

TEST(MoveSearch, ProvesThatTwoCannotChangePlacesInATube) {
  const PassingProblem problem = test::on_cells({"tube", {".a.b."}, {".b.a."}});
  EXPECT_EQ(find_few_moves(problem, {kEnough}).outcome, Outcome::kImpossible);
  const PassingProblem walled = test::on_cells({"walled", {"a#."}, {".#a"}});
  EXPECT_EQ(find_few_moves(walled, {0}).outcome, Outcome::kImpossible);
}

TEST(MoveSearch, StopsWhenItIsTold) {
  const PassingProblem problem = test::on_cells(test::puzzles()[0]);
  int asked = 0;
  const auto at_the_tenth = [&] { return ++asked == 10; };
  const PassingSequence sequence = find_few_moves(problem, {kEnough}, at_the_tenth);
  EXPECT_EQ(sequence.outcome, Outcome::kStopped);
  EXPECT_TRUE(sequence.steps.empty());
  EXPECT_EQ(asked, 10);
}

TEST(MoveSearch, StopsWhereItMayLookAtNoMore) {
  const PassingProblem problem = test::on_cells({"hall", {"a..."}, {"...a"}});
  EXPECT_EQ(find_few_moves(problem, {2}).outcome, Outcome::kStopped);
  EXPECT_EQ(find_few_moves(problem, {3}).outcome, Outcome::kFound);
}

TEST(MoveSearch, DrivesNoMoreThanItMay) {
  constexpr double kTimesLeast = 2.0;
  for (int seed = 0; seed < 200; ++seed) {
    const PassingProblem problem = test::random_problem(seed);
    const PassingSequence found = find_few_moves(problem, {kEnough, kTimesLeast});
    const PassingSequence least = find_few_moves(problem, {kEnough});
    ASSERT_EQ(found.outcome, least.outcome) << seed;
    if (found.outcome != Outcome::kFound) continue;
    test::expect_valid(problem, found.steps);
    expect_one_by_one(found.steps);
    const double least_m = test::driving_m(least.steps);
    EXPECT_LE(test::driving_m(found.steps), kTimesLeast * least_m + 1e-6) << seed;
  }
}

TEST(MoveSearch, FindsAWaySoonerWhereItMayDriveMore) {
  const PassingProblem problem =
      test::in_space({"hall", {"ab...", ".....", "...cd"}, {"cd...", ".....", "...ab"}});
  EXPECT_EQ(find_few_moves(problem, {1000}).outcome, Outcome::kStopped);
  EXPECT_EQ(find_few_moves(problem, {1000, 2.0}).outcome, Outcome::kFound);
}

TEST(MoveSearch, RefusesWhatIsNoProblem) {
  PassingProblem problem = test::on_cells(test::puzzles()[0]);
  problem.goals.pop_back();
  EXPECT_THROW(find_few_moves(problem, {kEnough}), std::invalid_argument);
}

TEST(MoveSearch, RefusesToDriveLessThanNeedBe) {
  const PassingProblem problem = test::on_cells(test::puzzles()[0]);
  EXPECT_THROW(find_few_moves(problem, {kEnough, 0.99}), std::invalid_argument);
  EXPECT_THROW(find_few_moves(problem, {kEnough, std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
