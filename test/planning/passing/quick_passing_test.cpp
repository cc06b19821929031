#include "planning/passing/quick_passing.h"

#include <gtest/gtest.h>

#include <functional>

#include "planning/passing/cell_world.h"
#include "planning/passing/solvability.h"

namespace mocha {
namespace {

using Steps = std::vector<JointStep>;

constexpr PassingPace kPace = {1.0, 0.5, 1.0, false, 1.0};
constexpr int kChoices = 20000;

bool go_on() { return false; }

double takes_s(const PassingProblem& problem, const Steps& steps) {
  return duration_s(order_of(steps, problem.robots()), kPace);
}

void expect_same(const Steps& a, const Steps& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int robot = 0; robot < a[i].robots(); ++robot)
      EXPECT_EQ(a[i].move(robot), b[i].move(robot)) << robot << " in step " << i;
  }
}

/// The puzzles that can be solved, with some solution.
void visit_solved(const std::function<void(const PassingProblem&, const Steps&)>& see) {
  int solved = 0;
  for (const auto& puzzle : test::puzzles()) {
    SCOPED_TRACE(puzzle.name);
    for (const PassingProblem& problem : {test::on_cells(puzzle), test::in_space(puzzle)}) {
      const Steps steps = test::solved(problem).steps;
      if (steps.empty()) continue;
      ++solved;
      see(problem, steps);
    }
  }
  EXPECT_GE(solved, 8);
}

TEST(QuickPassing, MakesPuzzlesQuickerAndNoneSlower) {
  double before_s = 0.0;
  double after_s = 0.0;
  visit_solved([&](const PassingProblem& problem, const Steps& steps) {
    const Steps quick = quickened(problem, steps, kPace, kChoices, go_on);
    test::expect_valid(problem, quick);
    EXPECT_LE(takes_s(problem, quick), takes_s(problem, steps));
    before_s += takes_s(problem, steps);
    after_s += takes_s(problem, quick);
  });
  EXPECT_LT(after_s, 0.9 * before_s);
}

TEST(QuickPassing, TakesNoLongerThanBeforeWhateverTheProblem) {
  for (int seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const PassingProblem problem = test::random_problem(seed);
    const PassingSequence sequence = test::solved(problem);
    if (sequence.outcome != PassingSequence::Outcome::kFound) continue;
    const Steps quick = quickened(problem, sequence.steps, kPace, 1000, go_on);
    test::expect_valid(problem, quick);
    EXPECT_LE(takes_s(problem, quick), takes_s(problem, sequence.steps));
  }
}

TEST(QuickPassing, IsTheSameEachTime) {
  visit_solved([](const PassingProblem& problem, const Steps& steps) {
    expect_same(quickened(problem, steps, kPace, 3000, go_on),
                quickened(problem, steps, kPace, 3000, go_on));
  });
}

TEST(QuickPassing, LeavesTheSequenceWhereItMayLookAtNothing) {
  visit_solved([](const PassingProblem& problem, const Steps& steps) {
    expect_same(quickened(problem, steps, kPace, 0, go_on), steps);
  });
}

TEST(QuickPassing, LooksAtNoMoreThanItMay) {
  visit_solved([](const PassingProblem& problem, const Steps& steps) {
    int asked = 0;  // for each choice, and a few times between
    const auto after_many = [&] { return ++asked >= 4000; };
    quickened(problem, steps, kPace, 1000, after_many);
    EXPECT_LT(asked, 4000);
  });
}

TEST(QuickPassing, StopsWhenItIsTold) {
  visit_solved([](const PassingProblem& problem, const Steps& steps) {
    expect_same(quickened(problem, steps, kPace, kChoices, [] { return true; }), steps);
    int asked = 0;
    const auto after_some = [&] { return ++asked > 500; };
    const Steps quick = quickened(problem, steps, kPace, kChoices, after_some);
    test::expect_valid(problem, quick);
    EXPECT_LE(takes_s(problem, quick), takes_s(problem, steps));
    EXPECT_LT(asked, 520);
  });
}

}  // namespace
}  // namespace mocha
