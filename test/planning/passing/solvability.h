#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <random>
#include <utility>
#include <vector>

#include "planning/passing/passing_problem.h"

namespace mocha::test {

inline constexpr double kPerMove_m = 1.0;  // what a move costs beside its length

inline bool is_free(const PlaceMove& move, const Placing& placing, int robot) {
  for (int other = 0; other < static_cast<int>(placing.size()); ++other) {
    if (other == robot) continue;
    if (move.blocked_by.contains(placing[other])) return false;
  }
  return true;
}

inline bool is_solved(const PassingProblem& problem, const Placing& placing) {
  for (std::size_t robot = 0; robot < placing.size(); ++robot) {
    if (problem.goals[robot] != PassingProblem::kAnywhere && problem.goals[robot] != placing[robot])
      return false;
  }
  return true;
}

/// What all have to drive at least, by moves one by one; infinite where there is no way. Looks at
/// all that can be reached (Dijkstra).
inline double least_driving_m(const PassingProblem& problem) {
  using Entry = std::pair<double, Placing>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::map<Placing, double> known_m = {{problem.starts, 0.0}};
  queue.emplace(0.0, problem.starts);
  while (!queue.empty()) {
    const auto [driven_m, placing] = queue.top();
    queue.pop();
    if (driven_m > known_m.at(placing)) continue;
    if (is_solved(problem, placing)) return driven_m;
    for (int robot = 0; robot < problem.robots(); ++robot) {
      for (const PlaceMove& move : problem.graph.moves[placing[robot]]) {
        if (!is_free(move, placing, robot)) continue;
        Placing next = placing;
        next[robot] = move.to;
        const double next_m = driven_m + move.length_m + kPerMove_m;
        const auto [known, is_new] = known_m.emplace(next, next_m);
        if (!is_new && known->second <= next_m) continue;
        known->second = next_m;
        queue.emplace(next_m, std::move(next));
      }
    }
  }
  return std::numeric_limits<double>::infinity();
}

inline bool can_be_solved(const PassingProblem& problem) {
  return std::isfinite(least_driving_m(problem));
}

/// What all drive.
inline double driving_m(const std::vector<JointStep>& steps) {
  double driven_m = 0.0;
  for (const JointStep& step : steps) {
    for (const int robot : step.order()) driven_m += step.move(robot)->length_m + kPerMove_m;
  }
  return driven_m;
}

/// Drives the steps move by move.
inline void expect_valid(const PassingProblem& problem, const std::vector<JointStep>& steps) {
  Placing placing = problem.starts;
  for (const JointStep& step : steps) {
    for (const int robot : step.order()) {
      ASSERT_EQ(step.from(robot), placing[robot]);
      ASSERT_TRUE(is_free(*step.move(robot), placing, robot));
      placing[robot] = step.to(robot);
    }
    EXPECT_EQ(step.placing(), placing);
  }
  EXPECT_TRUE(is_solved(problem, placing));
}

/// Places on a circle, so that ways are of many lengths.
inline PlaceGraph places_on_circle(int count) {
  PlaceGraph graph;
  for (int place = 0; place < count; ++place)
    graph.places.emplace_back(std::cos(place), std::sin(place));
  graph.moves.resize(count);
  return graph;
}

/// Random trees with a few more edges, and robots on most of their places.
inline PassingProblem random_problem(int seed) {
  std::mt19937 random(seed);
  const int places = 5 + seed % 4;
  const int robots = 2 + seed % 3;
  PassingProblem problem{places_on_circle(places), {}, {}};
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
      PlaceSet blocked_by = {to};
      const int passed = static_cast<int>(random() % places);
      if (random() % 5 == 0 && passed != to && passed != place) blocked_by.insert(passed);
      const auto& at = problem.graph.places;
      problem.graph.moves[place].push_back(
          {to, (at[to] - at[place]).norm(), {at[place], at[to]}, blocked_by});
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

}  // namespace mocha::test
