#include "topology/paths/class_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <random>
#include <set>
#include <stdexcept>

#include "topology/signatures/signature_sums.h"
#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding_m = 1e-9;

struct Network {
  Roadmap<2> roadmap;
  Cuts<2> cuts{{}};

  std::vector<ClassPath<2>> shortest(int classes, double longest_ratio) const {
    return shortest_classes(roadmap, cuts, {classes, longest_ratio});
  }
  int add_node(const Vector2& p) {
    roadmap.nodes.push_back({p, 1.0});
    return static_cast<int>(roadmap.nodes.size()) - 1;
  }
  void add_edge(int from, int to, std::vector<Vector2> between = {}, double detour = 1.0) {
    Roadmap<2>::Edge edge{from, to, std::move(between), 0.0, 1.0};
    const Path<2> line = line_of(edge);
    for (std::size_t i = 1; i < line.size(); ++i)
      edge.length_m += detour * (line[i] - line[i - 1]).norm();
    roadmap.edges.push_back(edge);
  }
  Path<2> line_of(const Roadmap<2>::Edge& edge) const {
    Path<2> line = {roadmap.nodes[edge.from].position};
    line.insert(line.end(), edge.between.begin(), edge.between.end());
    line.push_back(roadmap.nodes[edge.to].position);
    return line;
  }
};

/// Every two nodes share up to two edges, straight or bent, that may cost more than their length.
Network random_network(unsigned seed, int nodes, int obstacles, double density) {
  std::mt19937_64 random(seed);
  const auto point = [&] {
    const double x = uniform(random, 0.0, 10.0);
    return Vector2(x, uniform(random, 0.0, 10.0));
  };
  Network network;
  std::vector<Vector2> feet;
  for (int r = 0; r < obstacles; ++r) feet.push_back(point());
  network.cuts = Cuts<2>(feet);
  for (int i = 0; i < nodes; ++i) network.add_node(point());
  for (int i = 0; i < nodes; ++i) {
    for (int j = 0; j < i; ++j) {
      for (int twin = 0; twin < 2; ++twin) {
        if (uniform(random, 0.0, 1.0) > density) continue;
        std::vector<Vector2> between;
        if (twin == 1) between = {point(), point()};
        const bool backward = uniform(random, 0.0, 1.0) < 0.5;
        network.add_edge(backward ? i : j, backward ? j : i, between, uniform(random, 1.0, 1.3));
      }
    }
  }
  return network;
}

using Lengths = std::map<Signature, double>;

void include(Lengths& lengths, const Signature& signature, double length_m) {
  const auto known = lengths.try_emplace(signature, length_m).first;
  known->second = std::min(known->second, length_m);
}

struct Arc {
  int to;
  double length_m;
  Signature signature;
};

std::vector<std::vector<Arc>> arcs_of(const Network& network) {
  std::vector<std::vector<Arc>> arcs(network.roadmap.nodes.size());
  for (const auto& edge : network.roadmap.edges) {
    const Path<2> line = network.line_of(edge);
    const Path<2> back(line.rbegin(), line.rend());
    arcs[edge.from].push_back({edge.to, edge.length_m, signature_of(network.cuts, line)});
    arcs[edge.to].push_back({edge.from, edge.length_m, signature_of(network.cuts, back)});
  }
  return arcs;
}

Signature sum(Signature a, const Signature& b) {
  for (std::size_t r = 0; r < a.size(); ++r) a[r] += b[r];
  return a;
}

/// Goes along every path that visits no node twice.
class AllPaths {
 public:
  explicit AllPaths(const Network& network)
      : arcs_(arcs_of(network)), visited_(arcs_.size(), false) {
    go(Roadmap<2>::kStart, 0.0, Signature(network.cuts.obstacles(), 0));
  }
  const Lengths& shortest() const { return shortest_; }

 private:
  void go(int node, double length_m, const Signature& signature) {
    if (node == Roadmap<2>::kGoal) return include(shortest_, signature, length_m);
    visited_[node] = true;
    for (const Arc& arc : arcs_[node]) {
      if (!visited_[arc.to]) go(arc.to, length_m + arc.length_m, sum(signature, arc.signature));
    }
    visited_[node] = false;
  }

  const std::vector<std::vector<Arc>> arcs_;
  std::vector<bool> visited_;
  Lengths shortest_;
};

/// Of all walks up to a length, those that come back to a node included.
Lengths shortest_walks(const Network& network, double longest_m) {
  using State = std::pair<int, Signature>;
  using Entry = std::pair<double, State>;
  const auto arcs = arcs_of(network);
  std::set<State> reached;
  Lengths shortest;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  queue.push({0.0, {Roadmap<2>::kStart, Signature(network.cuts.obstacles(), 0)}});
  while (!queue.empty()) {
    const auto [length_m, state] = queue.top();
    queue.pop();
    if (length_m > longest_m || !reached.insert(state).second) continue;
    if (state.first == Roadmap<2>::kGoal) {
      include(shortest, state.second, length_m);
      continue;
    }
    for (const Arc& arc : arcs[state.first])
      queue.push({length_m + arc.length_m, {arc.to, sum(state.second, arc.signature)}});
  }
  return shortest;
}

double least(const Lengths& lengths) {
  double least_m = kInfinity;
  for (const auto& [signature, length_m] : lengths) least_m = std::min(least_m, length_m);
  return least_m;
}

/// Of pairwise different signatures, ascending, and without a node that is visited twice.
void expect_sound(const Network& network, const std::vector<ClassPath<2>>& paths) {
  std::set<Signature> signatures;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto& points = paths[i].points;
    EXPECT_TRUE(signatures.insert(signature_of(network.cuts, points)).second);
    if (i > 0) {
      EXPECT_GE(paths[i].length_m, paths[i - 1].length_m - kRounding_m);
    }
    EXPECT_EQ(points.front(), network.roadmap.nodes[Roadmap<2>::kStart].position);
    EXPECT_EQ(points.back(), network.roadmap.nodes[Roadmap<2>::kGoal].position);
    for (const auto& node : network.roadmap.nodes)
      EXPECT_LE(std::count(points.begin(), points.end(), node.position), 1);
  }
}

TEST(ClassSearch, FindsTheShortestPathOfEveryClassAsTryingAllPathsDoes) {
  int networks = 0;
  int all_classes = 0;
  int found_classes = 0;
  for (unsigned seed = 1; seed <= 500; ++seed) {
    const int nodes = 4 + seed % 5;
    const Network network = random_network(seed, nodes, 2 + seed % 4, 0.5);
    const Lengths all = AllPaths(network).shortest();
    if (all.empty()) continue;
    ++networks;
    const double ratio = 2.0 + seed % 7;
    const double longest_m = ratio * least(all);
    const Lengths walks = shortest_walks(network, longest_m);
    const auto paths = network.shortest(100000, ratio);
    expect_sound(network, paths);
    Lengths found;
    for (const auto& path : paths) {
      const Signature signature = signature_of(network.cuts, path.points);
      found[signature] = path.length_m;
      EXPECT_LE(path.length_m, longest_m + kRounding_m);
      ASSERT_TRUE(all.count(signature)) << seed;
      EXPECT_GE(path.length_m, all.at(signature) - kRounding_m) << seed;
    }
    for (const auto& [signature, length_m] : all) {
      if (length_m > longest_m - kRounding_m) continue;
      ++all_classes;
      const bool is_found = found.count(signature) && found[signature] < length_m + kRounding_m;
      found_classes += is_found ? 1 : 0;
      // Missed, or found longer, is only what a shorter walk through some node twice stands for.
      if (walks.at(signature) > length_m - kRounding_m) {
        EXPECT_TRUE(is_found) << seed;
      }
    }
  }
  EXPECT_GT(networks, 400);
  EXPECT_GT(all_classes, 1000);
  EXPECT_GT(found_classes, 0.9 * all_classes);
}

TEST(ClassSearch, ReturnsAsManyAsAskedAndTheShortestOfThem) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Network network = random_network(seed, 7, 4, 0.4);
    const auto all = network.shortest(1000, 3.0);
    for (const int classes : {1, 2, 5}) {
      const auto some = network.shortest(classes, 3.0);
      ASSERT_EQ(some.size(), std::min<std::size_t>(classes, all.size())) << seed;
      for (std::size_t i = 0; i < some.size(); ++i)
        EXPECT_NEAR(some[i].length_m, all[i].length_m, kRounding_m);
    }
  }
}

TEST(ClassSearch, ReturnsNothingLongerThanAllowed) {
  int cut_off = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Network network = random_network(seed, 7, 4, 0.4);
    const auto all = network.shortest(1000, kInfinity);
    for (const double ratio : {1.0, 1.2, 1.7}) {
      const auto some = network.shortest(1000, ratio);
      if (!all.empty()) {
        ASSERT_FALSE(some.empty()) << seed << ": the shortest is never too long";
      }
      for (std::size_t i = 0; i < all.size(); ++i) {
        const double limit_m = ratio * all.front().length_m;
        if (all[i].length_m < limit_m - kRounding_m) {
          EXPECT_LT(i, some.size()) << seed;
        }
        if (all[i].length_m > limit_m + kRounding_m) {
          EXPECT_GE(i, some.size()) << seed;
        }
      }
      cut_off += static_cast<int>(all.size() - some.size());
    }
  }
  EXPECT_GT(cut_off, 1000);
}

TEST(ClassSearch, TellsTwoEdgesBetweenTheSameNodesApart) {
  Network network;
  network.cuts = Cuts<2>({Vector2(5.0, 0.0)});
  network.add_node({0.0, 0.0});
  network.add_node({10.0, 0.0});
  network.add_edge(0, 1, {{5.0, 2.0}});
  network.add_edge(1, 0, {{8.0, -1.0}, {2.0, -1.0}});
  network.add_edge(0, 1, {{5.0, 3.0}});  // as the first, but longer
  const auto paths = network.shortest(6, 2.0);
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].points, (Path<2>{{0.0, 0.0}, {2.0, -1.0}, {8.0, -1.0}, {10.0, 0.0}}));
  EXPECT_EQ(paths[1].points, (Path<2>{{0.0, 0.0}, {5.0, 2.0}, {10.0, 0.0}}));
  EXPECT_NEAR(paths[0].length_m, 6.0 + 2.0 * std::sqrt(5.0), kRounding_m);
  EXPECT_NEAR(paths[1].length_m, 2.0 * std::sqrt(29.0), kRounding_m);
}

TEST(ClassSearch, FindsNothingWhereThereIsNoPath) {
  Network network;
  network.add_node({0.0, 0.0});
  network.add_node({10.0, 0.0});
  EXPECT_TRUE(network.shortest(6, 2.0).empty());
  network.add_node({5.0, 0.0});
  network.add_edge(0, 2);
  EXPECT_TRUE(network.shortest(6, kInfinity).empty());
}

TEST(ClassSearch, GoesNowhereFromTheStartToAGoalAtTheSamePlace) {
  Network network;
  network.cuts = Cuts<2>({Vector2(1.0, 1.0)});
  network.add_node({0.0, 0.0});
  network.add_node({0.0, 0.0});
  network.add_node({2.0, 2.0});
  network.add_edge(0, 1);
  network.add_edge(0, 2, {{0.0, 2.0}});
  network.add_edge(2, 1, {{2.0, 0.0}});
  for (const double ratio : {1.0, 2.0}) {
    const auto paths = network.shortest(6, ratio);
    ASSERT_EQ(paths.size(), 1u);
    EXPECT_EQ(paths[0].length_m, 0.0);
  }
  EXPECT_EQ(network.shortest(6, kInfinity).size(), 2u);
}

TEST(ClassSearch, WorksInSpace) {
  Roadmap<3> roadmap;
  roadmap.nodes = {{{0.0, 0.0, 1.0}, 1.0}, {{10.0, 0.0, 1.0}, 1.0}};
  roadmap.edges = {{0, 1, {{{5.0, 0.0, 1.0}}}, 10.0, 1.0}, {0, 1, {{{5.0, 0.0, 5.0}}}, 13.0, 1.0}};
  const Cuts<3> window(
      {Loop{{{5.0, -1.0, 0.0}, {5.0, 1.0, 0.0}, {5.0, 1.0, 2.0}, {5.0, -1.0, 2.0}}}});
  EXPECT_EQ(shortest_classes<3>(roadmap, window, {6, 2.0}).size(), 2u);
  EXPECT_EQ(shortest_classes<3>(roadmap, Cuts<3>({}), {6, 2.0}).size(), 1u);
}

TEST(ClassSearch, RefusesBadOptions) {
  Network network = random_network(1, 4, 1, 0.5);
  EXPECT_THROW(network.shortest(0, 2.0), std::invalid_argument);
  EXPECT_THROW(network.shortest(-3, 2.0), std::invalid_argument);
  EXPECT_THROW(network.shortest(6, 0.99), std::invalid_argument);
  EXPECT_THROW(network.shortest(6, std::nan("")), std::invalid_argument);
}

/// Obstacles in the squares of a street map of `columns` x `rows` crossings, which get the next
/// free numbers, row by row.
void add_streets(Network& network, std::vector<Vector2>& feet, const Vector2& corner, int columns,
                 int rows) {
  const int first = static_cast<int>(network.roadmap.nodes.size());
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      network.add_node(corner + Vector2(x, y));
      const int here = first + y * columns + x;
      const double detour = 1.0 + 1e-3 * (here * 7919 % 101);
      if (x > 0) network.add_edge(here - 1, here, {}, detour);
      if (y > 0) network.add_edge(here - columns, here, {}, detour);
      if (x > 0 && y > 0) feet.push_back(corner + Vector2(x - 0.5, y - 0.5));
    }
  }
}

// Millions of millions of classes are no longer than allowed in what follows, so it ends only if
// the search leaves nearly all of them alone.

TEST(ClassSearch, FindsEightClassesAmongFiveHundredObstacles) {
  Network network;
  std::vector<Vector2> feet;
  network.add_node({-1.0, 0.0});
  network.add_node({26.0, 20.0});
  add_streets(network, feet, {0.0, 0.0}, 26, 21);
  ASSERT_EQ(feet.size(), 500u);
  network.cuts = Cuts<2>(feet);
  network.add_edge(Roadmap<2>::kStart, 2);
  network.add_edge(static_cast<int>(network.roadmap.nodes.size()) - 1, Roadmap<2>::kGoal);
  const auto paths = network.shortest(8, 2.0);
  EXPECT_EQ(paths.size(), 8u);
  expect_sound(network, paths);
}

TEST(ClassSearch, DoesNotLoseItselfWhereNoWayLeadsOn) {
  // A room full of pillars beside the start, with one door; then with two, both beside the start.
  for (const int doors : {1, 2}) {
    Network network;
    std::vector<Vector2> feet;
    network.add_node({-1.0, 0.0});
    network.add_node({-60.0, 0.0});
    add_streets(network, feet, {0.0, 0.0}, 12, 12);
    network.cuts = Cuts<2>(feet);
    network.add_edge(Roadmap<2>::kStart, 2);
    if (doors == 2) network.add_edge(Roadmap<2>::kStart, 2 + 12, {{-1.0, 1.0}});
    network.add_edge(Roadmap<2>::kStart, Roadmap<2>::kGoal);
    EXPECT_EQ(network.shortest(8, 2.0).size(), 1u) << doors;
  }
}

TEST(ClassSearch, TakesClassesFromASpace) {
  class Plane : public SampledSpace<2> {
   public:
    Plane(const Cuts<2>& cuts, bool forward_only) : cuts_(cuts), forward_only_(forward_only) {}
    Vector2 at(const Vector2& shares) const override { return shares; }
    std::optional<double> clearance_m(const Vector2&) const override { return 1.0; }
    std::optional<double> clearance_m(const Vector2&, const Vector2&) const override { return 1.0; }
    bool in_order(const Vector2& p, const Vector2& q) const override {
      return !forward_only_ || p.x() < q.x();
    }
    SignatureKey key(const Vector2& p, const Vector2& q) const override {
      return key_of(cuts_, p, q);
    }

   private:
    const Cuts<2>& cuts_;
    bool forward_only_;
  };
  int forward = 0;
  int all = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    Network network = random_network(seed, 8, 3, 0.5);
    auto& edges = network.roadmap.edges;
    edges.erase(std::remove_if(edges.begin(), edges.end(),
                               [](const auto& edge) { return !edge.between.empty(); }),
                edges.end());
    const ClassSearchOptions options{5, 3.0};
    const auto expected = network.shortest(options.classes, options.longest_ratio);
    const auto found = shortest_classes<2>(network.roadmap, Plane(network.cuts, false), options);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].points, expected[i].points);
    for (const auto& path :
         shortest_classes<2>(network.roadmap, Plane(network.cuts, true), options)) {
      for (std::size_t i = 1; i < path.points.size(); ++i)
        EXPECT_LT(path.points[i - 1].x(), path.points[i].x());
      ++forward;
    }
    all += static_cast<int>(found.size());
  }
  EXPECT_GT(forward, 10);
  EXPECT_GT(all, forward);
}

}  // namespace
}  // namespace mocha
