#include "topology/roadmaps/roadmap_simplification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "topology/paths/class_search.h"
#include "topology/paths/path_shortcutting.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/shipped_options.h"
#include "topology/signatures/signature_sums.h"
#include "topology/static_map/primitive_static_map.h"

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Circles with paths between them.
struct Park {
  std::vector<Circle> circles;
  std::shared_ptr<PrimitiveStaticMap> static_map;
  Cuts<2> cuts{{}};
  Vector2 start{0.6, 4.0};
  Vector2 goal{9.4, 4.0};
  TravelOptions options = shipped_travel_options();

  explicit Park(int seed, int count = 12) {
    std::mt19937_64 random(seed);
    std::vector<Vector2> feet;
    while (static_cast<int>(circles.size()) < count) {
      const double x = uniform(random, 0.0, 10.0);
      const Circle circle{{x, uniform(random, 0.0, 8.0)}, uniform(random, 0.1, 0.6)};
      if (std::min(gap(start, circle).distance_m, gap(goal, circle).distance_m) < 0.5) continue;
      circles.push_back(circle);
      feet.push_back(circle.centre);
    }
    cuts = Cuts<2>(feet);
    static_map = std::make_shared<PrimitiveStaticMap>(
        std::make_shared<PrimitiveField<2>>(std::vector<Obstacle>(circles.begin(), circles.end()),
                                            2.0),
        Eigen::AlignedBox2d(Vector2(0.0, 0.0), Vector2(10.0, 8.0)));
  }
  TravelCost cost() const { return TravelCost(*static_map, start, {}, options); }
  Roadmap<2> roadmap() const {
    return visibility_prm<2>(static_map->field(), cuts, static_map->bounds(), start, goal,
                             {options.required_clearance_m, options.escape_radius_m},
                             prm_options(400));
  }
};

std::vector<Vector2> line_of(const Roadmap<2>& roadmap, const Roadmap<2>::Edge& edge) {
  std::vector<Vector2> line = {roadmap.nodes[edge.from].position};
  line.insert(line.end(), edge.between.begin(), edge.between.end());
  line.push_back(roadmap.nodes[edge.to].position);
  return line;
}

/// Sparse: with dead ends, chains, loops on one node and parts that hang together with nothing.
Roadmap<2> random_roadmap(int seed, int nodes, int edges) {
  std::mt19937_64 random(seed);
  const auto point = [&] {
    const double x = uniform(random, 0.0, 10.0);
    return Vector2(x, uniform(random, 0.0, 8.0));
  };
  Roadmap<2> roadmap;
  for (int i = 0; i < nodes; ++i) roadmap.nodes.push_back({point(), uniform(random, 0.3, 1.0)});
  std::uniform_int_distribution<int> node(0, nodes - 1);
  for (int i = 0; i < edges; ++i) {
    Roadmap<2>::Edge edge{node(random), node(random), {}, 0.0, uniform(random, 0.3, 1.0)};
    std::vector<Vector2> between;
    for (int k = i % 3; k > 0; --k) between.push_back(point());
    edge.between = std::move(between);
    const auto line = line_of(roadmap, edge);
    for (std::size_t k = 1; k < line.size(); ++k)
      edge.length_m += uniform(random, 1.0, 1.2) * (line[k] - line[k - 1]).norm();
    roadmap.edges.push_back(edge);
  }
  return roadmap;
}

Cuts<2> random_cuts(int seed, int obstacles) {
  std::mt19937_64 random(seed);
  std::vector<Vector2> feet;
  for (int r = 0; r < obstacles; ++r) {
    const double x = uniform(random, 0.0, 10.0);
    feet.push_back({x, uniform(random, 0.0, 8.0)});
  }
  return Cuts<2>(feet);
}

std::vector<int> degrees(const Roadmap<2>& roadmap) {
  std::vector<int> degree(roadmap.nodes.size(), 0);
  for (const auto& edge : roadmap.edges) {
    ++degree[edge.from];
    ++degree[edge.to];
  }
  return degree;
}

TEST(RoadmapSimplification, ContractionKeepsThePathsOfAllClasses) {
  int paths = 0;
  int saved = 0;
  for (int seed = 1; seed <= 300; ++seed) {
    const Roadmap<2> before = random_roadmap(seed, 14, 20 + seed % 6);
    const Cuts<2> cuts = random_cuts(seed, 5);
    const Roadmap<2> after = contracted(before);
    const auto known = shortest_classes(before, cuts, {1000, kInfinity});
    const auto kept = shortest_classes(after, cuts, {1000, kInfinity});
    ASSERT_EQ(kept.size(), known.size()) << seed;
    for (std::size_t i = 0; i < known.size(); ++i) {
      EXPECT_NEAR(kept[i].length_m, known[i].length_m, 1e-9) << seed;
      EXPECT_EQ(kept[i].points, known[i].points) << seed;
    }
    paths += static_cast<int>(known.size());
    saved += static_cast<int>(before.nodes.size() - after.nodes.size());
  }
  EXPECT_GT(paths, 1000);
  EXPECT_GT(saved, 1000);
}

TEST(RoadmapSimplification, ContractionLeavesNoDeadEndsAndNoNodesThatAreOnlyPassed) {
  for (int seed = 1; seed <= 300; ++seed) {
    const Roadmap<2> roadmap = contracted(random_roadmap(seed, 14, 10 + seed % 12));
    ASSERT_GE(roadmap.nodes.size(), 2u);
    const std::vector<int> degree = degrees(roadmap);
    for (std::size_t i = Roadmap<2>::kGoal + 1; i < degree.size(); ++i)
      EXPECT_GE(degree[i], 3) << seed;
    for (const auto& edge : roadmap.edges) {
      EXPECT_NE(edge.from, edge.to) << seed;
      ASSERT_LT(std::max(edge.from, edge.to), static_cast<int>(degree.size()));
    }
  }
}

TEST(RoadmapSimplification, ContractionTakesTheLeastClearanceAlong) {
  Roadmap<2> chain;
  chain.nodes = {{{0.0, 0.0}, 1.0}, {{3.0, 0.0}, 1.0}, {{1.0, 0.0}, 1.0}, {{2.0, 0.0}, 1.0}};
  chain.edges = {{2, 0, {{{0.5, 0.1}}}, 1.0, 0.9}, {3, 2, {}, 1.5, 0.4}, {3, 1, {}, 1.25, 0.7}};
  const Roadmap<2> edge = contracted(chain);
  ASSERT_EQ(edge.nodes.size(), 2u);
  ASSERT_EQ(edge.edges.size(), 1u);
  EXPECT_DOUBLE_EQ(edge.edges[0].length_m, 3.75);
  EXPECT_DOUBLE_EQ(edge.edges[0].clearance_m, 0.4);
  EXPECT_EQ(line_of(edge, edge.edges[0]),
            (std::vector<Vector2>{{0.0, 0.0}, {0.5, 0.1}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}}));
}

TEST(RoadmapSimplification, PricesLeaveOutWhatIsImpossible) {
  for (int seed = 1; seed <= 20; ++seed) {
    const Park park(seed);
    Roadmap<2> roadmap = random_roadmap(seed, 20, 60);
    roadmap.nodes[0].position = park.start;
    roadmap.nodes[1].position = park.goal;
    const TravelCost cost = park.cost();
    price(roadmap, cost);
    EXPECT_EQ(roadmap.nodes[0].position, park.start);
    EXPECT_EQ(roadmap.nodes[1].position, park.goal);
    EXPECT_LT(roadmap.edges.size(), 60u);
    for (const auto& edge : roadmap.edges) {
      ASSERT_TRUE(std::isfinite(edge.length_m));
      EXPECT_NEAR(edge.length_m, cost_of(line_of(roadmap, edge), cost), 1e-9);
    }
  }
}

TEST(RoadmapSimplification, PricesMoveWhatIsALittleTooCloseButNotFarther) {
  Park park(1, 0);
  park.static_map = std::make_shared<PrimitiveStaticMap>(
      std::make_shared<PrimitiveField<2>>(std::vector<Obstacle>{Circle{{5.0, 4.0}, 1.0}}, 2.0),
      Eigen::AlignedBox2d(Vector2(0.0, 0.0), Vector2(10.0, 8.0)));
  Roadmap<2> roadmap;
  roadmap.nodes = {{park.start, 1.0}, {park.goal, 1.0}, {{3.8, 4.0}, 0.2}, {{5.0, 6.0}, 1.0}};
  roadmap.edges = {{0, 2, {}, 0.0, 0.0}, {0, 3, {{{3.5, 5.5}, {5.0, 5.25}}}, 0.0, 0.0}};
  price(roadmap, park.cost());
  ASSERT_EQ(roadmap.edges.size(), 2u);
  EXPECT_NEAR((roadmap.nodes[2].position - Vector2(3.68, 4.0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(roadmap.nodes[3].position, Vector2(5.0, 6.0));
  EXPECT_EQ(roadmap.edges[1].between.points()[0], Vector2(3.5, 5.5));
  EXPECT_NEAR((roadmap.edges[1].between.points()[1] - Vector2(5.0, 5.32)).norm(), 0.0, 1e-9);
}

TEST(RoadmapSimplification, ShortcutsAreFreeAndMakeNoClassLonger) {
  int shorter = 0;
  int classes = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    const Park park(seed);
    const TravelCost cost = park.cost();
    Roadmap<2> before = park.roadmap();
    for (std::size_t i = before.edges.size(); i-- > 0;) {
      if (i % 3 == 0) before.edges.erase(before.edges.begin() + i);
    }
    price(before, cost);
    before = contracted(before);
    Roadmap<2> after = before;
    add_shortcuts(after, cost);
    ASSERT_EQ(after.nodes.size(), before.nodes.size());
    ASSERT_GE(after.edges.size(), before.edges.size());
    std::set<std::pair<int, int>> straight;
    for (std::size_t i = before.edges.size(); i < after.edges.size(); ++i) {
      const auto& edge = after.edges[i];
      EXPECT_TRUE(straight.emplace(std::minmax(edge.from, edge.to)).second) << "twice the same";
      EXPECT_TRUE(edge.between.empty());
      const auto line = line_of(after, edge);
      EXPECT_NEAR(edge.length_m, cost_of(line, cost), 1e-9);
      for (const Circle& circle : park.circles) {
        const double room_m =
            gap(nearest_on_segment(circle.centre, line[0], line[1]), circle).distance_m;
        EXPECT_GT(room_m, park.options.required_clearance_m - 0.004);
        EXPECT_GE(room_m, edge.clearance_m - 0.004);
      }
    }
    std::map<Signature, double> lengths;
    for (const auto& path : shortest_classes(after, park.cuts, {200, 2.0}))
      lengths[signature_of<2>(park.cuts, path.points)] = path.length_m;
    for (const auto& path : shortest_classes(before, park.cuts, {8, 1.5})) {
      const auto found = lengths.find(signature_of<2>(park.cuts, path.points));
      ++classes;
      if (found == lengths.end()) continue;  // by now longer than twice the shortest
      EXPECT_LE(found->second, path.length_m + 1e-9) << seed;
      shorter += found->second < 0.99 * path.length_m ? 1 : 0;
    }
  }
  EXPECT_GT(classes, 100);
  EXPECT_GT(shorter, 10);
}

}  // namespace
}  // namespace mocha
