#include "topology/roadmaps/visibility_prm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <random>
#include <stdexcept>

#include "topology/roadmaps/roadmap_classes.h"
#include "topology/shipped_options.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

struct PlanarWorld {
  std::vector<Circle> circles;
  AlignedBox2d bounds{Vector2d(0.0, 0.0), Vector2d(20.0, 20.0)};
  Vector2d start{1.0, 1.0};
  Vector2d goal{19.0, 19.0};
  ClearanceOptions clearance = shipped_clearance();

  PrimitiveField<2> field() const { return {{circles.begin(), circles.end()}, 2.0}; }
  Cuts<2> cuts() const {
    std::vector<Vector2d> centres;
    for (const Circle& circle : circles) centres.push_back(circle.centre);
    return Cuts<2>(centres);
  }
  Roadmap<2> roadmap(const VisibilityPrmOptions& options = prm_options()) const {
    return visibility_prm<2>(field(), cuts(), bounds, start, goal, clearance, options);
  }
};

PlanarWorld random_world(unsigned seed, int count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0.0, 20.0);
  std::uniform_real_distribution<double> radius(0.3, 1.6);
  PlanarWorld world;
  while (static_cast<int>(world.circles.size()) < count) {
    const Circle circle{{coordinate(random), coordinate(random)}, radius(random)};
    const double ends_m =
        std::min((circle.centre - world.start).norm(), (circle.centre - world.goal).norm());
    if (ends_m > circle.radius_m + 1.2) world.circles.push_back(circle);
  }
  return world;
}

template <int D>
bool joined(const Roadmap<D>& roadmap) {
  std::vector<int> group(roadmap.nodes.size());
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = static_cast<int>(i);
  for (const auto& edge : roadmap.edges) {
    const int gone = group[edge.from];
    std::replace(group.begin(), group.end(), gone, group[edge.to]);
  }
  return group[0] == group[1];
}

/// Flood fill over cells of 0.1 m whose centre keeps the clearance.
bool connected(const PlanarWorld& world, double clearance_m) {
  constexpr int kCells = 200;
  const PrimitiveField<2> field = world.field();
  const auto cell = [](const Vector2d& p) {
    return static_cast<int>(p.y() * 10.0) * kCells + static_cast<int>(p.x() * 10.0);
  };
  std::vector<bool> seen(kCells * kCells, false);
  std::queue<int> queue;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= kCells || y >= kCells || seen[y * kCells + x]) return;
    const Vector2d centre(0.1 * x + 0.05, 0.1 * y + 0.05);
    if (field.distance_bound(centre) < clearance_m) return;
    seen[y * kCells + x] = true;
    queue.push(y * kCells + x);
  };
  visit(cell(world.start) % kCells, cell(world.start) / kCells);
  while (!queue.empty()) {
    const int at = queue.front();
    queue.pop();
    for (const int step : {-1, 1}) {
      visit(at % kCells + step, at / kCells);
      visit(at % kCells, at / kCells + step);
    }
  }
  return seen[cell(world.goal)];
}

template <int D>
void expect_sound(const Roadmap<D>& roadmap, const ObstacleField<D>& field,
                  const ClearanceOptions& options) {
  const auto start = roadmap.nodes[0].position;
  const double start_m = field.distance_bound(start);
  for (const auto& edge : roadmap.edges) {
    const auto p = roadmap.nodes[edge.from].position;
    const auto q = roadmap.nodes[edge.to].position;
    EXPECT_TRUE(edge.between.empty());
    EXPECT_DOUBLE_EQ(edge.length_m, (q - p).norm());
    double least_m = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 300; ++i) {
      const auto at = (p + (q - p) * (i / 300.0)).eval();
      const double distance_m = field.distance_bound(at);
      least_m = std::min(least_m, distance_m);
      const bool escaping = (at - start).norm() < options.escape_radius_m + 1e-9;
      const double required_m =
          escaping ? std::min(options.required_m, start_m - 0.003) : options.required_m;
      ASSERT_GE(distance_m, required_m) << p.transpose() << " to " << q.transpose();
    }
    EXPECT_LE(edge.clearance_m, least_m);
    EXPECT_GE(edge.clearance_m, 0.4 * least_m);
  }
  for (const auto& node : roadmap.nodes) {
    EXPECT_LE(node.clearance_m, field.distance_bound(node.position));
  }
}

TEST(VisibilityPrm, EdgesKeepTheClearanceThatTheyState) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const PlanarWorld world = random_world(seed, 30);
    const Roadmap<2> roadmap = world.roadmap();
    EXPECT_EQ(roadmap.nodes[Roadmap<2>::kStart].position, world.start);
    EXPECT_EQ(roadmap.nodes[Roadmap<2>::kGoal].position, world.goal);
    expect_sound<2>(roadmap, world.field(), world.clearance);
  }
}

TEST(VisibilityPrm, JoinsStartAndGoalWhereverThereIsAGenerousPath) {
  int open = 0;
  int closed = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const PlanarWorld world = random_world(seed, 40 + static_cast<int>(seed));
    const double required_m = world.clearance.required_m;
    const bool found = joined(world.roadmap());
    if (connected(world, required_m + 0.15)) {
      EXPECT_TRUE(found) << "seed " << seed;
      ++open;
    } else if (!connected(world, required_m - 0.08)) {
      EXPECT_FALSE(found) << "seed " << seed;
      ++closed;
    }
  }
  EXPECT_GT(open, 10);
  EXPECT_GT(closed, 5);
}

TEST(VisibilityPrm, FindsAllFourClassesOfTwoObstaclesInARow) {
  PlanarWorld world;
  world.circles = {{{7.0, 10.0}, 1.5}, {{13.0, 10.0}, 1.5}};
  world.start = {1.0, 10.0};
  world.goal = {19.0, 10.0};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const VisibilityPrmOptions options = prm_options(1000, seed);
    const PrimitiveField<2> field = world.field();
    const Cuts<2> cuts = world.cuts();
    const StaticSpace<2> space(field, cuts, world.bounds, world.start, world.clearance);
    const auto classes = shortest_of_each_class<2>(
        visibility_prm<2>(space, world.start, world.goal, options), space, 25.0);
    for (const double first : {7.0, 13.0}) {
      for (const double second : {7.0, 13.0}) {
        const std::vector<Vector2d> path = {world.start, {7.0, first}, {13.0, second}, world.goal};
        SignatureKey key = 0;
        for (std::size_t i = 1; i < path.size(); ++i) key += space.key(path[i - 1], path[i]);
        ASSERT_EQ(classes.count(key), 1u) << "seed " << seed;
        EXPECT_LT(classes.at(key), first == second ? 19.5 : 1.25 * 19.7) << "seed " << seed;
      }
    }
  }
}

TEST(VisibilityPrm, ShortestPathsAreHardlyLongerThanTheyMustBe) {
  PlanarWorld world;
  world.circles = {{{10.0, 10.0}, 4.0}};
  world.start = {1.0, 10.0};
  world.goal = {19.0, 10.0};
  const PrimitiveField<2> field = world.field();
  const Cuts<2> cuts = world.cuts();
  const StaticSpace<2> space(field, cuts, world.bounds, world.start, world.clearance);
  const auto classes = shortest_of_each_class<2>(world.roadmap(), space, 26.0);
  const double radius_m = 4.0 + world.clearance.required_m;
  const double tangent_m = std::sqrt(81.0 - radius_m * radius_m);
  const double shortest_m = 2.0 * (tangent_m + radius_m * std::asin(radius_m / 9.0));
  ASSERT_EQ(classes.size(), 2u);
  for (const auto& [key, length_m] : classes) {
    EXPECT_GT(length_m, shortest_m - 1e-6);
    EXPECT_LT(length_m, 1.05 * shortest_m);
  }
}

TEST(VisibilityPrm, StaysSmallHoweverManySamplesAreDrawn) {
  const PlanarWorld world = random_world(3, 20);
  VisibilityPrmOptions options = prm_options(2000);
  const std::size_t few = world.roadmap(options).nodes.size();
  options.samples = 30000;
  EXPECT_LT(world.roadmap(options).nodes.size(), 3 * few);
  EXPECT_LT(few, 150u);
}

TEST(VisibilityPrm, JoinsWhatWasSampledWhenItIsStopped) {
  PlanarWorld world;
  world.circles = {{{10.0, 10.0}, 2.0}};
  VisibilityPrmOptions options = prm_options(1'000'000);
  int looks = 0;
  options.should_stop = [&] { return ++looks > 500; };
  const Roadmap<2> roadmap = world.roadmap(options);
  EXPECT_TRUE(joined(roadmap));
  EXPECT_LE(looks, 502);
}

TEST(VisibilityPrm, IsTheSameForTheSameSeed) {
  const PlanarWorld world = random_world(5, 30);
  VisibilityPrmOptions options = prm_options(500);
  const Roadmap<2> one = world.roadmap(options);
  const Roadmap<2> two = world.roadmap(options);
  ASSERT_EQ(one.nodes.size(), two.nodes.size());
  ASSERT_EQ(one.edges.size(), two.edges.size());
  for (std::size_t i = 0; i < one.nodes.size(); ++i) {
    EXPECT_EQ(one.nodes[i].position, two.nodes[i].position);
  }
  for (std::size_t i = 0; i < one.edges.size(); ++i) {
    EXPECT_EQ(one.edges[i].from, two.edges[i].from);
    EXPECT_EQ(one.edges[i].to, two.edges[i].to);
    EXPECT_EQ(one.edges[i].clearance_m, two.edges[i].clearance_m);
  }
  options.seed = 2;
  EXPECT_NE(world.roadmap(options).nodes.back().position, one.nodes.back().position);
}

TEST(VisibilityPrm, DrawsTheNumbersOfTheGeneratorItself) {
  PlanarWorld world;
  world.goal = world.start + Vector2d(0.5, 0.0);
  world.bounds = {Vector2d(0.0, 0.0), Vector2d(1.0, 1.0)};
  const Roadmap<2> roadmap = world.roadmap(prm_options(1, 5489));
  ASSERT_EQ(roadmap.nodes.size(), 3u);
  EXPECT_EQ(roadmap.nodes[2].position.x(), (14514284786278117030u >> 11) * 0x1p-53);
}

TEST(VisibilityPrm, WhoStandsTooCloseMayLeaveButNotComeCloser) {
  PlanarWorld world;
  world.circles = {{{10.0, 10.0}, 3.0}};
  world.start = {6.9, 10.0};  // 10 cm off, 30 are required
  world.goal = {19.0, 10.0};
  const Roadmap<2> roadmap = world.roadmap();
  EXPECT_TRUE(joined(roadmap));
  expect_sound<2>(roadmap, world.field(), world.clearance);
  world.clearance.escape_radius_m = 0.0;
  EXPECT_FALSE(joined(world.roadmap()));
  world.clearance.escape_radius_m = 0.6;
  world.start = {7.1, 10.0};  // inside
  EXPECT_FALSE(joined(world.roadmap()));
}

TEST(VisibilityPrm, AStartBetweenTwoWallsMayLeaveAlongThem) {
  PlanarWorld world;
  for (double x = 9.25; x < 10.0; x += 0.1) {
    for (const double y : {9.6, 10.4}) world.circles.push_back({{x, y}, 0.2});
  }
  world.start = {9.7, 9.96};  // 16 cm off, 30 are required and nowhere near
  const Roadmap<2> roadmap = world.roadmap();
  EXPECT_TRUE(joined(roadmap));
  expect_sound<2>(roadmap, world.field(), world.clearance);
}

TEST(VisibilityPrm, BlockedEndsHaveNoEdges) {
  PlanarWorld world;
  world.circles = {{{19.0, 19.0}, 1.0}};
  for (const Vector2d& goal : {Vector2d(19.0, 19.0), Vector2d(18.8, 17.9)}) {
    world.goal = goal;
    const Roadmap<2> roadmap = world.roadmap();
    for (const auto& edge : roadmap.edges) {
      EXPECT_NE(edge.from, Roadmap<2>::kGoal);
      EXPECT_NE(edge.to, Roadmap<2>::kGoal);
    }
  }
  world.circles = {{{10.0, 10.0}, 100.0}};
  EXPECT_EQ(world.roadmap().nodes.size(), 2u);
  EXPECT_TRUE(world.roadmap().edges.empty());
}

TEST(VisibilityPrm, DegenerateQuestionsHaveAnswers) {
  PlanarWorld world;
  const Roadmap<2> open = world.roadmap();  // no obstacles
  EXPECT_TRUE(joined(open));
  EXPECT_EQ(open.edges.front().clearance_m, std::numeric_limits<double>::infinity());

  PlanarWorld same = world;
  same.goal = same.start;
  EXPECT_EQ(same.roadmap().nodes.size(), 2u);
  EXPECT_EQ(same.roadmap().edges.size(), 1u);

  PlanarWorld empty = world;
  empty.bounds.setEmpty();
  EXPECT_EQ(empty.roadmap().nodes.size(), 2u);
  EXPECT_EQ(empty.roadmap().edges.size(), 1u);

  PlanarWorld flat = world;
  flat.bounds = {flat.start, flat.start};
  EXPECT_TRUE(joined(flat.roadmap()));

  PlanarWorld nowhere = world;
  nowhere.goal.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(nowhere.roadmap().nodes.size(), 2u);
  EXPECT_TRUE(nowhere.roadmap().edges.empty());

  EXPECT_EQ(world.roadmap(prm_options(0)).nodes.size(), 2u);
}

TEST(VisibilityPrm, RefusesRulesOutOfRange) {
  PlanarWorld world;
  EXPECT_THROW(world.roadmap(prm_options(-1)), std::invalid_argument);
  for (const double reach_m : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    VisibilityPrmOptions options = prm_options();
    options.reach_m = reach_m;
    EXPECT_THROW(world.roadmap(options), std::invalid_argument) << reach_m;
  }
  for (const double bad : {-0.1, std::nan(""), HUGE_VAL}) {
    world.clearance = {};
    world.clearance.required_m = bad;
    EXPECT_THROW(world.roadmap(), std::invalid_argument) << bad;
    world.clearance = {};
    world.clearance.escape_radius_m = bad;
    EXPECT_THROW(world.roadmap(), std::invalid_argument) << bad;
  }
}

}  // namespace
}  // namespace mocha
