#include "planning/passing/partial_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "planning/passing/cell_world.h"
#include "planning/passing/move_search.h"
#include "planning/passing/solvability.h"

namespace mocha {
namespace {

using Outcome = PassingSequence::Outcome;
using Steps = std::vector<JointStep>;

constexpr int kEnough = 10000000;  // choices, for all that is asked here

bool go_on() { return false; }

/// What a search for these robots takes it to cost.
double cost_m(const JointStep& step, const std::vector<int>& searched) {
  double farthest_m = 0.0;
  double all_m = 0.0;
  for (const int robot : step.order()) {
    const double driven_m = step.move(robot)->length_m + test::kPerMove_m;
    farthest_m = std::max(farthest_m, driven_m);
    if (std::count(searched.begin(), searched.end(), robot) > 0) all_m += driven_m;
  }
  return farthest_m + 0.1 * all_m;
}

double cost_m(const Steps& steps, const std::vector<int>& searched) {
  double sum_m = 0.0;
  for (const JointStep& step : steps) sum_m += cost_m(step, searched);
  return sum_m;
}

const PlaceMove* move_in(const Steps& steps, std::size_t number, int robot) {
  return number < steps.size() ? steps[number].move(robot) : nullptr;
}

void expect_others_as_before(const Steps& before, const Steps& after,
                             const std::vector<int>& searched) {
  ASSERT_FALSE(before.empty());
  for (int robot = 0; robot < before.front().robots(); ++robot) {
    if (std::count(searched.begin(), searched.end(), robot) > 0) continue;
    for (std::size_t i = 0; i < std::max(before.size(), after.size()); ++i)
      EXPECT_EQ(move_in(after, i, robot), move_in(before, i, robot)) << robot << " in step " << i;
  }
}

/// Each two of the robots, and each alone.
std::vector<std::vector<int>> choices_of(int robots) {
  std::vector<std::vector<int>> choices;
  for (int robot = 0; robot < robots; ++robot) {
    choices.push_back({robot});
    for (int other = 0; other < robot; ++other) choices.push_back({robot, other});
  }
  return choices;
}

/// Of random problems with at least one step to do.
void visit_solved(int seeds, const std::function<void(const PassingProblem&, const Steps&)>& see) {
  int solved = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    const PassingProblem problem = test::random_problem(seed);
    const Steps steps = test::solved(problem).steps;
    if (steps.empty()) continue;
    ++solved;
    see(problem, steps);
  }
  EXPECT_GT(solved, seeds / 3);
}

TEST(PartialSearch, CostsNoMoreThanBeforeAndLeavesTheMovesOfTheOthers) {
  double before_m = 0.0;
  double after_m = 0.0;
  visit_solved(150, [&](const PassingProblem& problem, const Steps& steps) {
    const PartialSearch search(problem);
    for (const auto& robots : choices_of(problem.robots())) {
      int left = kEnough;
      const PassingSequence found = search.run(steps, robots, 0, left, go_on);
      ASSERT_EQ(found.outcome, Outcome::kFound);
      test::expect_valid(problem, found.steps);
      expect_others_as_before(steps, found.steps, robots);
      EXPECT_LE(cost_m(found.steps, robots), cost_m(steps, robots) + 1e-6);
      before_m += cost_m(steps, robots);
      after_m += cost_m(found.steps, robots);
    }
  });
  EXPECT_LT(after_m, before_m);
}

TEST(PartialSearch, EachVariantIsValid) {
  visit_solved(60, [](const PassingProblem& problem, const Steps& steps) {
    const PartialSearch search(problem);
    const auto choices = choices_of(problem.robots());
    for (std::size_t variant = 1; variant < 8; ++variant) {
      const auto& robots = choices[variant % choices.size()];
      int left = kEnough;
      const PassingSequence found = search.run(steps, robots, variant, left, go_on);
      ASSERT_EQ(found.outcome, Outcome::kFound);
      test::expect_valid(problem, found.steps);
      expect_others_as_before(steps, found.steps, robots);
    }
  });
}

/// All steps in which those from `robot` on have yet to choose.
void visit_steps(const JointStep& step, int robot,
                 const std::function<void(const JointStep&)>& see) {
  if (robot == step.robots()) return see(step);
  JointStep stays = step;
  if (stays.choose(robot, nullptr)) visit_steps(stays, robot + 1, see);
  for (const PlaceMove& move : step.graph().moves[step.from(robot)]) {
    JointStep moves = step;
    if (moves.choose(robot, &move)) visit_steps(moves, robot + 1, see);
  }
}

/// What it costs at least where all are searched for; looks at all that can be reached (Dijkstra).
double least_cost_m(const PassingProblem& problem, const std::vector<int>& all) {
  using Entry = std::pair<double, Placing>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::map<Placing, double> known_m = {{problem.starts, 0.0}};
  queue.emplace(0.0, problem.starts);
  while (!queue.empty()) {
    const auto [reached_m, placing] = queue.top();
    queue.pop();
    if (reached_m > known_m.at(placing)) continue;
    if (test::is_solved(problem, placing)) return reached_m;
    visit_steps({problem.graph, placing}, 0, [&, from_m = reached_m](const JointStep& step) {
      const double next_m = from_m + cost_m(step, all);
      const auto [known, is_new] = known_m.emplace(step.placing(), next_m);
      if (!is_new && known->second <= next_m) return;
      known->second = next_m;
      queue.emplace(next_m, step.placing());
    });
  }
  return std::numeric_limits<double>::infinity();
}

TEST(PartialSearch, OfAllRobotsItFindsWhatCostsLeast) {
  visit_solved(90, [](const PassingProblem& problem, const Steps& steps) {
    std::vector<int> all(problem.robots());
    std::iota(all.begin(), all.end(), 0);
    int left = kEnough;
    const PassingSequence found = PartialSearch(problem).run(steps, all, 0, left, go_on);
    ASSERT_EQ(found.outcome, Outcome::kFound);
    test::expect_valid(problem, found.steps);
    EXPECT_NEAR(cost_m(found.steps, all), least_cost_m(problem, all), 1e-6);
  });
}

/// Steps in which one robot after the other goes from place to place, and the others stay.
Steps one_by_one(const PassingProblem& problem, const std::vector<std::pair<int, int>>& moves) {
  Steps steps;
  Placing placing = problem.starts;
  for (const auto& [mover, to] : moves) {
    JointStep step(problem.graph, placing);
    for (int robot = 0; robot < problem.robots(); ++robot) {
      const auto& ways = problem.graph.moves[placing[robot]];
      const auto way = std::find_if(ways.begin(), ways.end(),
                                    [to = to](const PlaceMove& move) { return move.to == to; });
      EXPECT_TRUE(step.choose(robot, robot == mover ? &*way : nullptr));
    }
    placing = step.placing();
    steps.push_back(step);
  }
  return steps;
}

TEST(PartialSearch, NobodyDrivesToAndFroForNothing) {
  const PassingProblem problem =
      test::on_cells({"apart", {"a..", "###", "b.."}, {"..a", "###", "b.."}});
  const Steps detour = one_by_one(problem, {{0, 1}, {1, 4}, {0, 2}, {1, 3}});
  test::expect_valid(problem, detour);
  int left = kEnough;
  const PassingSequence found = PartialSearch(problem).run(detour, {1}, 0, left, go_on);
  ASSERT_EQ(found.outcome, Outcome::kFound);
  test::expect_valid(problem, found.steps);
  ASSERT_EQ(found.steps.size(), 3u);
  for (const JointStep& step : found.steps) EXPECT_EQ(step.move(1), nullptr);
  expect_others_as_before(detour, found.steps, {1});
}

TEST(PartialSearch, RobotsThatDoNotMeetDriveAtOnce) {
  const PassingProblem problem =
      test::on_cells({"apart", {"a..", "###", "b.."}, {"..a", "###", "..b"}});
  const Steps slow = one_by_one(problem, {{0, 1}, {0, 2}, {1, 4}, {1, 5}});
  int left = kEnough;
  const PassingSequence found = PartialSearch(problem).run(slow, {0, 1}, 0, left, go_on);
  EXPECT_EQ(found.steps.size(), 2u);
}

TEST(PartialSearch, ProvesThatOthersAreInTheWay) {
  const PassingProblem problem = test::on_cells({"corridor", {"ab.", "##."}, {".ba", "##."}});
  int left = kEnough;
  const PartialSearch search(problem);
  EXPECT_EQ(search.run({}, {0}, 0, left, go_on).outcome, Outcome::kImpossible);
  EXPECT_EQ(search.run({}, {0, 1}, 0, left, go_on).outcome, Outcome::kImpossible);
}

TEST(PartialSearch, CountsDownTheChoicesAndStopsWhereNoneIsLeft) {
  const PassingProblem problem = test::on_cells(test::puzzles()[3]);
  const PassingSequence sequence = test::solved(problem);
  ASSERT_EQ(sequence.outcome, Outcome::kFound);
  const PartialSearch search(problem);
  const int most = 100000;
  int left = most;
  ASSERT_EQ(search.run(sequence.steps, {0, 1}, 0, left, go_on).outcome, Outcome::kFound);
  const int needed = most - left;
  EXPECT_GT(needed, 10);
  left = needed;
  EXPECT_EQ(search.run(sequence.steps, {0, 1}, 0, left, go_on).outcome, Outcome::kFound);
  EXPECT_EQ(left, 0);
  left = needed - 1;
  const PassingSequence stopped = search.run(sequence.steps, {0, 1}, 0, left, go_on);
  EXPECT_EQ(stopped.outcome, Outcome::kStopped);
  EXPECT_TRUE(stopped.steps.empty());
  EXPECT_LE(left, 0);
}

TEST(PartialSearch, StopsWhenItIsTold) {
  const PassingProblem problem = test::on_cells(test::puzzles()[3]);
  const Steps steps = test::solved(problem).steps;
  int left = kEnough;
  int asked = 0;
  const auto at_the_tenth = [&] { return ++asked == 10; };
  const PassingSequence found = PartialSearch(problem).run(steps, {0, 1}, 0, left, at_the_tenth);
  EXPECT_EQ(found.outcome, Outcome::kStopped);
  EXPECT_EQ(asked, 10);
}

TEST(PartialSearch, FindsTheMovesOfAsManyAsItMay) {
  const PassingProblem problem =
      test::on_cells({"row", {"abcdef.", "......."}, {".abcdef", "......."}});
  ASSERT_EQ(problem.robots(), PartialSearch::kMostTogether);
  const PassingSequence sequence = find_few_moves(problem, {kEnough});
  ASSERT_EQ(sequence.steps.size(), 6u);  // one by one
  int left = kEnough;
  const PassingSequence found =
      PartialSearch(problem).run(sequence.steps, {0, 1, 2, 3, 4, 5}, 0, left, go_on);
  ASSERT_EQ(found.outcome, Outcome::kFound);
  test::expect_valid(problem, found.steps);
  EXPECT_EQ(found.steps.size(), 1u);
}

}  // namespace
}  // namespace mocha
