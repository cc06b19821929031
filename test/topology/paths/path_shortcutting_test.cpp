#include "topology/paths/path_shortcutting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "topology/grid_world.h"
#include "topology/shipped_options.h"

namespace mocha {
namespace {

using Outcome = GridPath::Outcome;

double length_of(const std::vector<Vector2>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}

double clearance_of(const std::vector<Vector2>& path, const ObstacleField<2>& field) {
  double least_m = field.distance_bound(path.front());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 step = path[i] - path[i - 1];
    const int samples = 1 + static_cast<int>(step.norm() / 2e-3);
    for (int k = 0; k <= samples; ++k)
      least_m = std::min(least_m, field.distance_bound(path[i - 1] + step * k / samples));
  }
  return least_m;
}

Cuts<2> cuts_of(const StaticMap& static_map, double clearance_m) {
  std::vector<Vector2> feet;
  for (const ObstacleGroup& group : static_map.groups(clearance_m))
    feet.push_back(group.representative);
  return Cuts<2>(feet);
}

/// From start to goal by way of some places, on the lattice; empty if there is none.
std::vector<Vector2> by_way_of(const std::vector<Vector2>& places, const StaticMap& static_map,
                               const TravelCost& cost) {
  std::vector<Vector2> path = {places.front()};
  for (std::size_t i = 1; i < places.size(); ++i) {
    const GridPath part = find_grid_path(static_map, places[i - 1], places[i], cost, 0.05);
    if (part.outcome != Outcome::kFound) return {};
    path.insert(path.end(), part.points.begin() + 1, part.points.end());
  }
  return path;
}

TEST(PathShortcutting, KeepsEndsClassAndClearanceAndCostsNoMore) {
  const Vector2 start(0.5, 0.5);
  const Vector2 goal(7.5, 5.5);
  const TravelOptions options = shipped_travel_options();
  int detours = 0;
  int wound = 0;
  for (int seed = 1; seed <= 80; ++seed) {
    const auto static_map = static_map_of(random_world(seed, 22, start, goal, 0.4));
    const TravelCost cost(*static_map, start, {}, options);
    const Cuts<2> cuts = cuts_of(*static_map, options.required_clearance_m);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.4, 7.6);
    std::uniform_real_distribution<double> y(0.4, 5.6);
    const auto free_place = [&] {
      for (;;) {
        const Vector2 p(x(random), y(random));
        if (std::isfinite(cost.at(p))) return p;
      }
    };
    const Vector2 first = free_place();
    const Vector2 second = free_place();
    const auto path = by_way_of({start, first, second, goal}, *static_map, cost);
    if (path.empty()) continue;
    const double before = cost_of(path, cost);
    ASSERT_TRUE(std::isfinite(before));
    const auto shorter = with_shortcuts(path, cost, cuts);
    ASSERT_GE(shorter.size(), 2u);
    EXPECT_EQ(shorter.front(), start);
    EXPECT_EQ(shorter.back(), goal);
    EXPECT_EQ(signature_of<2>(cuts, shorter), signature_of<2>(cuts, path)) << seed;
    EXPECT_LE(cost_of(shorter, cost), before) << seed;
    // What lines lose between two samples.
    EXPECT_GE(clearance_of(shorter, static_map->field()), options.required_clearance_m - 0.004)
        << seed;
    ++detours;
    const auto direct = find_grid_path(*static_map, start, goal, cost, 0.05);
    wound += signature_of<2>(cuts, direct.points) != signature_of<2>(cuts, path) ? 1 : 0;
  }
  EXPECT_GT(detours, 50);
  EXPECT_GT(wound, 30);
}

TEST(PathShortcutting, StaysPossibleFromBarelyFreePlaces) {
  TravelOptions options = shipped_travel_options();
  int found = 0;
  for (int seed = 1; seed <= 300; ++seed) {
    const auto static_map = static_map_of(random_world(seed % 30, 28, {0.5, 0.5}, {7.5, 5.5}, 0.4));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.0, 8.0);
    std::uniform_real_distribution<double> y(0.0, 6.0);
    const auto between = [&](double low_m, double high_m) {
      for (;;) {
        const Vector2 p(x(random), y(random));
        const double distance_m = static_map->field().sample(p).distance_m;
        if (distance_m > low_m && distance_m < high_m) return p;
      }
    };
    const Vector2 start = between(0.1, 0.32);
    const Vector2 goal = between(0.3, 0.32);
    const TravelCost cost(*static_map, start, {}, options);
    const auto path = by_way_of({start, goal}, *static_map, cost);
    if (path.empty() || !std::isfinite(cost_of(path, cost))) continue;
    ++found;
    const auto shorter = with_shortcuts(path, cost, cuts_of(*static_map, 0.1));
    EXPECT_LE(cost_of(shorter, cost), cost_of(path, cost)) << seed;
  }
  EXPECT_GT(found, 150);
}

TEST(PathShortcutting, LeavesAPathWoundRoundAnObstacle) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {3.5, 2.5}, {4.5, 3.5});
  const auto static_map = static_map_of(grid);
  TravelOptions options = shipped_travel_options();
  options.preferred_clearance_m = options.required_clearance_m;
  const Vector2 start(1.0, 3.0);
  const TravelCost cost(*static_map, start, {}, options);
  const Cuts<2> cuts = cuts_of(*static_map, options.required_clearance_m);
  std::vector<Vector2> path = {start};
  for (double angle = M_PI; angle > -2.0 * M_PI; angle -= 0.1)
    path.push_back(Vector2(4.0, 3.0) + 1.9 * Vector2(std::cos(angle), std::sin(angle)));
  path.push_back({7.0, 3.0});
  const Signature once_and_a_half = signature_of<2>(cuts, path);
  ASSERT_EQ(once_and_a_half, Signature{-2});
  const auto shorter = with_shortcuts(path, cost, cuts);
  EXPECT_EQ(signature_of<2>(cuts, shorter), once_and_a_half);
  // Round the box and half round again: its sides, the quarter circles at its corners, the
  // tangents.
  const double round_m = 4.0 + 2.0 * M_PI * 0.3;
  EXPECT_GT(length_of(shorter), 6.0 + round_m);
  EXPECT_LT(length_of(shorter), 6.6 + round_m + 0.2);
}

/// Straight paths beyond it are free and shorter, but of another class.
TEST(PathShortcutting, DoesNotJumpOverAPost) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {32.0, 32.0}, 0.1);
  const Vector2 post(16.05, 16.05);
  fill_box(grid, post - Vector2(0.05, 0.05), post + Vector2(0.05, 0.05));
  const auto static_map = static_map_of(grid);
  const TravelOptions options = shipped_travel_options();
  const Cuts<2> cuts = cuts_of(*static_map, options.required_clearance_m);
  for (double from = 0.0; from < 2.0 * M_PI; from += 0.3) {
    std::vector<Vector2> path;
    for (double angle = 0.0; angle < 1.7 * M_PI; angle += 0.05)
      path.push_back(post + 14.0 * Vector2(std::cos(from + angle), std::sin(from + angle)));
    const TravelCost cost(*static_map, path.front(), {}, options);
    const auto shorter = with_shortcuts(path, cost, cuts);
    EXPECT_EQ(signature_of<2>(cuts, shorter), signature_of<2>(cuts, path)) << from;
    EXPECT_LT(length_of(shorter), 30.0) << from;
    const auto direct = with_shortcuts(path, cost, Cuts<2>({}));
    EXPECT_LT(length_of(direct), 14.0) << from;
  }
}

TEST(PathShortcutting, IsNearlyAsShortAsCanBe) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {4.0, 0.0}, {4.05, 4.0});
  const auto static_map = static_map_of(grid);
  TravelOptions options = shipped_travel_options();
  options.preferred_clearance_m = options.required_clearance_m;
  const Vector2 start(2.0, 2.0);
  const Vector2 goal(6.0, 2.0);
  const TravelCost cost(*static_map, start, {}, options);
  const std::vector<Vector2> wide = {start, {2.0, 5.5}, {6.0, 5.5}, goal};
  const double r = options.required_clearance_m;
  const double reach_m = std::hypot(2.0, 2.0);
  const double shortest_m =
      2.0 * (std::sqrt(reach_m * reach_m - r * r) + r * (0.75 * M_PI - std::acos(r / reach_m))) +
      0.05;
  const auto shorter = with_shortcuts(wide, cost, Cuts<2>({}));
  EXPECT_LT(length_of(shorter), 1.02 * shortest_m);
}

TEST(PathShortcutting, LeavesAloneWhatCannotBeShorter) {
  const auto static_map = static_map_of(free_grid({0.0, 0.0}, {8.0, 6.0}));
  const TravelCost cost(*static_map, {1.0, 1.0}, {}, shipped_travel_options());
  const Cuts<2> none({});
  EXPECT_TRUE(with_shortcuts({}, cost, none).empty());
  const std::vector<Vector2> point = {{1.0, 1.0}};
  EXPECT_EQ(with_shortcuts(point, cost, none), point);
  const std::vector<Vector2> nowhere = {{1.0, 1.0}, {1.0, 1.0}};
  EXPECT_EQ(with_shortcuts(nowhere, cost, none), nowhere);
  const std::vector<Vector2> straight = {{1.0, 1.0}, {7.0, 5.0}};
  EXPECT_EQ(with_shortcuts(straight, cost, none), straight);
}

TEST(PathShortcutting, CutsNothingOfAnImpossiblePath) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {3.5, 2.5}, {4.5, 3.5});
  const auto static_map = static_map_of(grid);
  const TravelCost cost(*static_map, {1.0, 3.0}, {}, shipped_travel_options());
  const std::vector<Vector2> through = {{1.0, 3.0}, {4.0, 3.0}, {7.0, 3.0}};
  const auto same = with_shortcuts(through, cost, Cuts<2>({Vector2(4.0, 2.6)}));
  EXPECT_EQ(cost_of(same, cost), TravelCost::kInfinity);
  EXPECT_NEAR(length_of(same), 6.0, 1e-9);
}

}  // namespace
}  // namespace mocha
