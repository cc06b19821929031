#include "topology/roadmaps/apollonius_roadmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>

#include "topology/shipped_options.h"

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kStart = Roadmap<2>::kStart;
constexpr int kGoal = Roadmap<2>::kGoal;

struct World {
  Eigen::AlignedBox2d bounds{Vector2(0.0, 0.0), Vector2(10.0, 8.0)};
  Vector2 start{0.5, 4.0};
  Vector2 goal{9.5, 4.0};
  std::vector<Circle> circles;
  SkeletonOptions options = shipped_skeleton_options();

  Roadmap<2> roadmap() const {
    std::vector<ObstacleGroup> groups;
    for (const Circle& circle : circles) groups.push_back({circle.centre, {circle}});
    return apollonius_roadmap(groups, bounds, start, goal, options);
  }

  /// To all circles, ascending.
  std::vector<double> clearances_m(const Vector2& p) const {
    std::vector<double> all;
    for (const Circle& circle : circles) all.push_back(gap(p, circle).distance_m);
    std::sort(all.begin(), all.end());
    return all;
  }

  double clearance_m(const Vector2& p) const {
    double least = kInfinity;
    for (const Circle& circle : circles) least = std::min(least, gap(p, circle).distance_m);
    return least;
  }

  /// True where the virtual wall, which is outside of the bounds, cannot be as near as `clearance`.
  bool is_inside(const Vector2& p, double clearance) const {
    return std::min((p - bounds.min()).minCoeff(), (bounds.max() - p).minCoeff()) > clearance;
  }

  void translate(const Vector2& by) {
    bounds.translate(by);
    start += by;
    goal += by;
    for (Circle& circle : circles) circle.centre += by;
  }
};

World random_world(int seed, int count, double most_radius_m, double required_m) {
  World world;
  world.options.required_clearance_m = required_m;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(0.0, 10.0), y(0.0, 8.0), radius(0.0, most_radius_m);
  world.start = {x(random), y(random)};
  world.goal = {x(random), y(random)};
  while (static_cast<int>(world.circles.size()) < count) {
    const Circle circle{{x(random), y(random)}, radius(random)};
    const double room_m =
        std::min(gap(world.start, circle).distance_m, gap(world.goal, circle).distance_m);
    if (room_m > 1.1 * required_m) world.circles.push_back(circle);
  }
  return world;
}

bool touches_ends(const Roadmap<2>::Edge& edge) { return std::min(edge.from, edge.to) <= kGoal; }

std::vector<Vector2> polyline(const Roadmap<2>& map, const Roadmap<2>::Edge& edge) {
  std::vector<Vector2> points = {map.nodes[edge.from].position};
  points.insert(points.end(), edge.between.begin(), edge.between.end());
  points.push_back(map.nodes[edge.to].position);
  return points;
}

std::vector<Vector2> samples(const std::vector<Vector2>& line, double step_m) {
  std::vector<Vector2> dense = {line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2 side = line[i] - line[i - 1];
    const int steps = 1 + static_cast<int>(side.norm() / step_m);
    for (int k = 1; k <= steps; ++k) dense.push_back(line[i - 1] + side * k / steps);
  }
  return dense;
}

/// The number of each node's connected part, in the graph without what touches nodes below `first`.
std::vector<int> parts(const Roadmap<2>& map, int first = 0) {
  std::vector<int> part(map.nodes.size());
  std::iota(part.begin(), part.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& edge : map.edges) {
      if (std::min(edge.from, edge.to) < first || part[edge.from] == part[edge.to]) continue;
      part[edge.from] = part[edge.to] = std::min(part[edge.from], part[edge.to]);
      changed = true;
    }
  }
  return part;
}

bool connected(const Roadmap<2>& map) {
  const std::vector<int> part = parts(map);
  return part[kStart] == part[kGoal];
}

/// Independent loops of the skeleton, without the straight edges of start and goal.
int loops(const Roadmap<2>& map) {
  const std::vector<int> part = parts(map, kGoal + 1);
  int count = 0;
  for (int i = kGoal + 1; i < static_cast<int>(map.nodes.size()); ++i) {
    count += part[i] == i ? 1 : 0;  // a part
    count -= 1;
  }
  for (const auto& edge : map.edges) count += touches_ends(edge) ? 0 : 1;
  return count;
}

/// Whether the goal is reached from the start over a lattice's points of at least this clearance.
bool floods(const World& world, double clearance_m, double step_m, bool diagonally) {
  const double margin_m = 1.0 + 4.0 * clearance_m;
  const Vector2 low = world.bounds.min().array() - margin_m;
  const Vector2 size = world.bounds.sizes().array() + 2.0 * margin_m;
  const int columns = static_cast<int>(size.x() / step_m);
  const int rows = static_cast<int>(size.y() / step_m);
  std::vector<char> is_free(static_cast<std::size_t>(columns) * rows, 1);
  for (const Circle& circle : world.circles) {
    const double reach = circle.radius_m + clearance_m;
    const Eigen::Array2d from = ((circle.centre - low).array() - reach) / step_m;
    const Eigen::Array2d to = ((circle.centre - low).array() + reach) / step_m;
    for (int y = std::max(0, int(from.y()) - 1); y <= std::min(rows - 1, int(to.y()) + 1); ++y) {
      for (int x = std::max(0, int(from.x()) - 1); x <= std::min(columns - 1, int(to.x()) + 1);
           ++x) {
        const Vector2 p = low + step_m * Vector2(x + 0.5, y + 0.5);
        if ((p - circle.centre).norm() < reach) is_free[y * columns + x] = 0;
      }
    }
  }
  const auto cell = [&](const Vector2& p) {
    const Vector2 at = (p - low) / step_m;
    return static_cast<int>(at.y()) * columns + static_cast<int>(at.x());
  };
  std::vector<int> stack = {cell(world.start)};
  while (!stack.empty()) {
    const int at = stack.back();
    stack.pop_back();
    if (!is_free[at]) continue;
    if (at == cell(world.goal)) return true;
    is_free[at] = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = at % columns + dx;
        const int y = at / columns + dy;
        if (!diagonally && dx != 0 && dy != 0) continue;
        if (x >= 0 && x < columns && y >= 0 && y < rows) stack.push_back(y * columns + x);
      }
    }
  }
  return false;
}

/// The largest clearance at which the goal is reached over the lattice's points, to a millimetre.
double bottleneck_m(const World& world, double step_m, bool diagonally) {
  double reached_m = 0.0;
  double missed_m =
      step_m + std::min(world.clearance_m(world.start), world.clearance_m(world.goal));
  while (missed_m - reached_m > 1e-3) {
    const double middle_m = 0.5 * (reached_m + missed_m);
    (floods(world, middle_m, step_m, diagonally) ? reached_m : missed_m) = middle_m;
  }
  return diagonally ? missed_m : reached_m;
}

/// Against brute force: all that a roadmap states about clearance and length.
void expect_true(const World& world, const Roadmap<2>& map) {
  const double required_m = world.options.required_clearance_m;
  for (std::size_t i = 2; i < map.nodes.size(); ++i) {
    const auto& node = map.nodes[i];
    const double clearance_m = world.clearance_m(node.position);
    EXPECT_GE(node.clearance_m, required_m);
    EXPECT_GE(clearance_m, node.clearance_m - 1e-8);
    if (world.is_inside(node.position, clearance_m)) {
      EXPECT_NEAR(node.clearance_m, clearance_m, 1e-8);
    }
  }
  for (const auto& edge : map.edges) {
    ASSERT_NE(edge.from, edge.to);
    EXPECT_GE(edge.clearance_m, required_m);
    const std::vector<Vector2> line = polyline(map, edge);
    double length_m = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) length_m += (line[i] - line[i - 1]).norm();
    EXPECT_NEAR(edge.length_m, length_m, 1e-9);
    double least_m = kInfinity;
    bool walled = false;
    for (const Vector2& p : samples(line, 2e-3)) {
      const std::vector<double> clearances_m = world.clearances_m(p);
      least_m = std::min(least_m, clearances_m[0]);
      walled = walled || !world.is_inside(p, 1.1 * clearances_m[0]);
      if (walled || touches_ends(edge) || clearances_m.size() < 2) continue;
      EXPECT_NEAR(clearances_m[0], clearances_m[1], 0.042 * clearances_m[1]) << p.transpose();
    }
    EXPECT_GE(least_m, 0.98 * edge.clearance_m - 1e-8);
    if (!walled) {
      EXPECT_LE(least_m, edge.clearance_m + 1e-5);
    }
  }
}

TEST(ApolloniusRoadmap, StatesTheTruthAboutClearances) {
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const World world = random_world(seed, 5 + 2 * seed, seed % 2 ? 1.2 : 0.4, 0.05 + 0.01 * seed);
    const Roadmap<2> map = world.roadmap();
    ASSERT_GT(map.edges.size(), 4u);
    EXPECT_EQ(map.nodes[kStart].position, world.start);
    EXPECT_EQ(map.nodes[kGoal].position, world.goal);
    expect_true(world, map);
  }
}

TEST(ApolloniusRoadmap, HasVerticesEquallyFarFromThreeCircles) {
  const World world = random_world(7, 40, 0.6, 0.15);
  const Roadmap<2> map = world.roadmap();
  std::vector<int> degree(map.nodes.size(), 0);
  for (const auto& edge : map.edges) {
    ++degree[edge.from];
    ++degree[edge.to];
  }
  int seen = 0;
  for (std::size_t i = 2; i + 2 < map.nodes.size(); ++i) {  // the last two are feet
    const std::vector<double> clearances_m = world.clearances_m(map.nodes[i].position);
    if (degree[i] < 3 || !world.is_inside(map.nodes[i].position, clearances_m[2])) continue;
    EXPECT_NEAR(clearances_m[0], clearances_m[2], 1e-8);
    ++seen;
  }
  EXPECT_GT(seen, 15);
}

TEST(ApolloniusRoadmap, ConnectsWhateverIsConnected) {
  const double step_m = 0.04;
  int narrow = 0;
  for (int seed = 0; seed < 76; seed += 2) {
    SCOPED_TRACE(seed);
    World world = random_world(seed, 5 + seed, seed % 4 ? 0.9 : 0.3, 0.0);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(1.0, 4.0), y(1.0, 7.0);
    for (int i = 0; i < 100; ++i) {  // ends with room, so that the way is narrowest in between
      const Vector2 p(x(random) + i % 2 * 5.0, y(random));
      Vector2& end = i % 2 ? world.goal : world.start;
      if (world.clearance_m(p) > world.clearance_m(end)) end = p;
    }
    world.options.escape_radius_m = 0.0;
    world.options.required_clearance_m = bottleneck_m(world, step_m, false) - M_SQRT1_2 * step_m;
    EXPECT_TRUE(connected(world.roadmap()));
    world.options.required_clearance_m = bottleneck_m(world, step_m, true) + M_SQRT1_2 * step_m;
    EXPECT_FALSE(connected(world.roadmap()));
    const double ends_m = std::min(world.clearance_m(world.start), world.clearance_m(world.goal));
    narrow += world.options.required_clearance_m < ends_m ? 1 : 0;  // elsewhere than at an end
  }
  EXPECT_GT(narrow, 10);
}

TEST(ApolloniusRoadmap, HasALoopForEveryObstacleThatCanBeGoneRound) {
  World world;
  EXPECT_EQ(loops(world.roadmap()), 0);
  world.circles = {{{2.0, 2.0}, 0.3}, {{5.0, 2.5}, 0.7}, {{8.0, 2.0}, 0.0},
                   {{3.0, 6.0}, 0.5}, {{6.5, 5.5}, 0.2}, {{0.0, 8.0}, 0.4},  // on the rim
                   {{10.0, 4.0}, 0.4}};
  EXPECT_EQ(loops(world.roadmap()), 7);
  world.circles.push_back({{2.4, 2.1}, 0.2});  // part of the first
  world.circles.push_back({{3.6, 6.7}, 0.1});  // too close to the fourth to pass between
  EXPECT_EQ(loops(world.roadmap()), 7);
  world.options.required_clearance_m = 0.1;
  EXPECT_EQ(loops(world.roadmap()), 8);
}

TEST(ApolloniusRoadmap, JoinsStartAndGoalStraightWhereTheLineIsFree) {
  World world;
  world.circles = {{{5.0, 4.35}, 0.04}, {{5.0, 3.65}, 0.04}};
  const auto straight = [](const Roadmap<2>& map) {
    return std::find_if(map.edges.begin(), map.edges.end(), [](const auto& edge) {
      return std::max(edge.from, edge.to) == kGoal && std::min(edge.from, edge.to) == kStart;
    });
  };
  const Roadmap<2> open = world.roadmap();
  ASSERT_NE(straight(open), open.edges.end());
  EXPECT_NEAR(straight(open)->clearance_m, 0.31, 1e-12);
  EXPECT_NEAR(straight(open)->length_m, 9.0, 1e-12);
  world.circles[0].centre.y() = 4.33;
  const Roadmap<2> closed = world.roadmap();
  EXPECT_EQ(straight(closed), closed.edges.end());
  EXPECT_TRUE(connected(closed));
}

TEST(ApolloniusRoadmap, FindsAWayForAStartThatHasAllNearNodesBehindAWall) {
  World world;
  for (int i = 0; i <= 40; ++i) world.circles.push_back({{1.0 + 0.2 * i, 4.0}, 0.11});
  for (int i = 0; i <= 800; ++i) world.circles.push_back({{1.0 + 0.01 * i, 3.2}, 0.01});
  world.start = {5.0, 4.5};
  world.goal = {5.0, 1.0};
  const Roadmap<2> map = world.roadmap();
  EXPECT_TRUE(connected(map));
  expect_true(world, map);
}

TEST(ApolloniusRoadmap, LeadsAStartOutThatIsCloserThanRequired) {
  World world;
  world.start = {0.5, 4.5};
  world.circles = {{{0.5, 3.8}, 0.5}, {{0.5, 5.1}, 0.3}};  // in a gap of 0.5 m
  const Roadmap<2> map = world.roadmap();
  ASSERT_NEAR(map.nodes[kStart].clearance_m, 0.2, 1e-12);
  EXPECT_TRUE(connected(map));
  for (const auto& edge : map.edges) {
    for (const Vector2& p : samples(polyline(map, edge), 2e-3)) {
      const double least_m = (p - world.start).norm() > 0.6 ? 0.294 : 0.196;
      ASSERT_GE(world.clearance_m(p), least_m) << p.transpose();
    }
  }
  world.options.escape_radius_m = 0.2;
  EXPECT_FALSE(connected(world.roadmap()));
}

TEST(ApolloniusRoadmap, HasNoEdgesToAnEndThatIsBlocked) {
  const auto edges_at = [](const Roadmap<2>& map, int node) {
    return std::count_if(map.edges.begin(), map.edges.end(),
                         [&](const auto& edge) { return edge.from == node || edge.to == node; });
  };
  World world;
  world.circles = {{{5.0, 4.0}, 0.5}};
  EXPECT_GT(edges_at(world.roadmap(), kGoal), 0);
  world.goal = {5.0, 4.7};  // too close
  EXPECT_EQ(edges_at(world.roadmap(), kGoal), 0);
  EXPECT_GT(edges_at(world.roadmap(), kStart), 0);
  std::swap(world.start, world.goal);
  world.start = world.circles[0].centre;  // inside
  EXPECT_EQ(edges_at(world.roadmap(), kStart), 0);
  EXPECT_LT(world.roadmap().nodes[kStart].clearance_m, 0.0);
}

TEST(ApolloniusRoadmap, TakesDegenerateCircles) {
  World world;
  for (int i = 0; i < 9; ++i) {
    for (int k = 0; k < 7; ++k) {  // a lattice of points: four on every circle between
      if (i != 4 || k != 3) world.circles.push_back({{1.0 + i, 1.0 + k}, 0.0});
    }
  }
  for (int i = 0; i < 5; ++i) world.circles.push_back(world.circles[i]);  // the same again
  world.circles.push_back({{5.0, 4.0}, 0.35});
  world.circles.push_back({{5.0, 4.0}, 0.2});   // concentric
  world.circles.push_back({{5.1, 4.0}, 0.25});  // touching from inside
  world.circles.push_back({{5.2, 4.0}, 0.19});  // overlapping
  world.circles.push_back({{3.0 + 1e-12, 3.0}, 1e-12});
  world.start = {0.5, 4.0};
  world.goal = {9.5, 4.5};
  const Roadmap<2> map = world.roadmap();
  EXPECT_TRUE(connected(map));
  EXPECT_EQ(loops(map), 63);
  expect_true(world, map);
}

TEST(ApolloniusRoadmap, FindsTheDoorInALongWall) {
  World world;
  world.bounds = {Vector2(0.0, 0.0), Vector2(100.0, 20.0)};
  world.start = {50.0, 5.0};
  world.goal = {20.0, 15.0};
  for (int i = 0; i < 2000; ++i) world.circles.push_back({{0.05 * i, 10.0}, 0.05});
  const auto crossings = [&](const Roadmap<2>& map) {  // of the wall's line inside of the bounds
    int count = 0;
    for (const auto& edge : map.edges) {
      const std::vector<Vector2> line = polyline(map, edge);
      for (std::size_t i = 1; i < line.size(); ++i) {
        count += touches_ends(edge) || (line[i].y() > 10.0) == (line[i - 1].y() > 10.0) ||
                         !world.is_inside(line[i], 0.0)
                     ? 0
                     : 1;
      }
    }
    return count;
  };
  EXPECT_EQ(crossings(world.roadmap()), 0);
  EXPECT_EQ(loops(world.roadmap()), 1);  // round the whole wall
  // A door of 0.7 m between 70 and 71 m.
  world.circles.erase(std::remove_if(world.circles.begin(), world.circles.end(),
                                     [](const Circle& circle) {
                                       return circle.centre.x() > 70.0 && circle.centre.x() < 70.76;
                                     }),
                      world.circles.end());
  const Roadmap<2> map = world.roadmap();
  EXPECT_EQ(crossings(map), 1);
  EXPECT_EQ(loops(map), 2);
  EXPECT_TRUE(connected(map));
}

TEST(ApolloniusRoadmap, IsTheSameFarFromTheOrigin) {
  for (int seed = 0; seed < 5; ++seed) {
    World world = random_world(seed, 40, 0.6, 0.2);
    const Roadmap<2> near = world.roadmap();
    const Vector2 by(12345.0, -23456.0);
    world.translate(by);
    const Roadmap<2> far = world.roadmap();
    ASSERT_EQ(far.nodes.size(), near.nodes.size());
    ASSERT_EQ(far.edges.size(), near.edges.size());
    for (std::size_t i = 0; i < near.nodes.size(); ++i) {
      EXPECT_LT((far.nodes[i].position - by - near.nodes[i].position).norm(), 1e-6);
    }
  }
}

TEST(ApolloniusRoadmap, IsTheSameAgain) {
  const World world = random_world(3, 80, 0.4, 0.1);
  const Roadmap<2> first = world.roadmap();
  std::vector<std::unique_ptr<char[]>> litter;  // so that memory is handed out in another order
  for (int i = 0; i < 400; ++i) litter.push_back(std::make_unique<char[]>(64 + 37 * i % 9000));
  for (int i = 0; i < 400; i += 3) litter[i * 7 % 400].reset();
  const Roadmap<2> again = world.roadmap();
  ASSERT_EQ(again.nodes.size(), first.nodes.size());
  ASSERT_EQ(again.edges.size(), first.edges.size());
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    EXPECT_EQ(again.nodes[i].position, first.nodes[i].position);
    EXPECT_EQ(again.nodes[i].clearance_m, first.nodes[i].clearance_m);
  }
  for (std::size_t i = 0; i < first.edges.size(); ++i) {
    EXPECT_EQ(again.edges[i].from, first.edges[i].from);
    EXPECT_EQ(again.edges[i].to, first.edges[i].to);
    EXPECT_EQ(again.edges[i].between, first.edges[i].between);
    EXPECT_EQ(again.edges[i].length_m, first.edges[i].length_m);
    EXPECT_EQ(again.edges[i].clearance_m, first.edges[i].clearance_m);
  }
}

TEST(ApolloniusRoadmap, RefusesWhatIsNoWorld) {
  const auto refuses = [](auto&& spoil) {
    World world;
    world.circles = {{{5.0, 4.0}, 0.5}};
    spoil(world);
    EXPECT_THROW(world.roadmap(), std::invalid_argument);
  };
  const double nan = std::nan("");
  refuses([&](World& world) { world.options.required_clearance_m = 0.0; });
  refuses([&](World& world) { world.options.required_clearance_m = nan; });
  refuses([&](World& world) { world.start.x() = nan; });
  refuses([&](World& world) { world.goal.y() = kInfinity; });
  refuses([&](World& world) { world.circles[0].radius_m = -0.1; });
  refuses([&](World& world) { world.circles[0].radius_m = nan; });
  refuses([&](World& world) { world.circles[0].centre.x() = 2e6; });
  refuses([&](World& world) { world.bounds.setEmpty(); });
}

}  // namespace
}  // namespace mocha
