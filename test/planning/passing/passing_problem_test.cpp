#include "planning/passing/passing_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "planning/passing/cell_world.h"

namespace mocha {
namespace {

using test::kCell_m;

/// Two robots in a corridor of four cells.
PassingProblem corridor() {
  return test::on_cells({"corridor", {"a..b", "####", "...."}, {"b..a", "####", "...."}});
}

TEST(PassingProblem, RefusesStartsAndGoalsOfDifferentNumbers) {
  PassingProblem problem = corridor();
  EXPECT_NO_THROW(validate(problem));
  problem.goals.pop_back();
  EXPECT_THROW(validate(problem), std::invalid_argument);
  problem.starts = {};
  EXPECT_THROW(validate(problem), std::invalid_argument);
}

TEST(PassingProblem, RefusesStartsThatAreNoPlaces) {
  for (const int start : {PassingProblem::kAnywhere, corridor().graph.size()}) {
    PassingProblem problem = corridor();
    problem.starts[1] = start;
    EXPECT_THROW(validate(problem), std::invalid_argument) << start;
  }
}

TEST(PassingProblem, RefusesGoalsThatAreNoPlacesUnlessTheyAreAnywhere) {
  PassingProblem problem = corridor();
  problem.goals[1] = PassingProblem::kAnywhere;
  EXPECT_NO_THROW(validate(problem));
  for (const int goal : {PassingProblem::kAnywhere - 1, problem.graph.size()}) {
    problem.goals[1] = goal;
    EXPECT_THROW(validate(problem), std::invalid_argument) << goal;
  }
}

TEST(PassingProblem, WhoHasNoGoalIsThereEverywhere) {
  PassingProblem problem = corridor();
  EXPECT_TRUE(problem.is_at_goal(0, 3));
  EXPECT_FALSE(problem.is_at_goal(0, 0));
  problem.goals[0] = PassingProblem::kAnywhere;
  EXPECT_TRUE(problem.is_at_goal(0, 0));
  EXPECT_FALSE(problem.is_at_goal(1, 3));
}

TEST(GoalDistances, AreThoseAlongTheGraph) {
  const GoalDistances distances_m(corridor());
  EXPECT_DOUBLE_EQ(distances_m(0, 0), 3.0 * kCell_m);
  EXPECT_DOUBLE_EQ(distances_m(1, 1), kCell_m);
  EXPECT_EQ(distances_m(0, 3), 0.0);
}

TEST(GoalDistances, CountEachMoveAsSoMuchLonger) {
  const GoalDistances distances_m(corridor(), 0.5);
  EXPECT_DOUBLE_EQ(distances_m(0, 0), 3.0 * (kCell_m + 0.5));
  EXPECT_EQ(distances_m(0, 3), 0.0);
}

/// The way by the other place is shorter than the straight one, but of two moves.
TEST(GoalDistances, AreThoseOfFewerMovesWhereMovesCount) {
  PassingProblem problem;
  problem.graph.places.assign(3, Vector2::Zero());
  problem.graph.moves = {{{1, 1.0, {}, {1}}, {2, 2.5, {}, {2}}},
                         {{0, 1.0, {}, {0}}, {2, 1.0, {}, {2}}},
                         {{0, 2.5, {}, {0}}, {1, 1.0, {}, {1}}}};
  problem.starts = {0};
  problem.goals = {2};
  EXPECT_DOUBLE_EQ(GoalDistances(problem)(0, 0), 2.0);
  EXPECT_DOUBLE_EQ(GoalDistances(problem, 1.0)(0, 0), 3.5);
}

TEST(GoalDistances, AreInfiniteWhereThereIsNoWayAndNoneWithoutAGoal) {
  PassingProblem problem = corridor();
  const int beyond_the_wall = problem.graph.size() - 1;
  EXPECT_TRUE(std::isinf(GoalDistances(problem)(0, beyond_the_wall)));
  problem.goals[0] = PassingProblem::kAnywhere;
  EXPECT_EQ(GoalDistances(problem, 1.0)(0, beyond_the_wall), 0.0);
}

}  // namespace
}  // namespace mocha
