#include "topology/signatures/length_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <random>
#include <set>
#include <tuple>

#include "topology/grid_world.h"
#include "topology/shipped_options.h"
#include "topology/signatures/h_signature.h"
#include "topology/static_map/primitive_static_map.h"

namespace mocha {
namespace {

/// The shortest lattice path of each of the first few classes, by a search over pairs of node and
/// signature: what no bound may exceed.
class ClassedLattice {
 public:
  ClassedLattice(const StaticMap& static_map, double clearance_m, double step_m)
      : static_map_(static_map), clearance_m_(clearance_m), step_m_(step_m), cuts_(cuts()) {
    const Vector2 steps = static_map.bounds().sizes() / step_m;
    columns_ = static_cast<int>(steps.x() + 1e-6) + 1;
    rows_ = static_cast<int>(steps.y() + 1e-6) + 1;
    free_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (int i = 0; i < columns_ * rows_; ++i)
      free_[i] = static_map.field().distance_bound(position(i)) >= clearance_m;
  }

  Vector2 nearest_node(const Vector2& p) const { return position(node_at(p)); }
  bool is_free(const Vector2& p) const { return free_[node_at(p)]; }

  std::vector<std::vector<Vector2>> paths(const Vector2& start, const Vector2& goal, int classes) {
    std::vector<Step> steps = {{node_at(start), -1, 0, 0.0}};
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    std::map<int, std::set<SignatureKey>> seen;
    queue.push({0.0, 0});
    std::vector<std::vector<Vector2>> found;
    while (!queue.empty() && static_cast<int>(found.size()) < classes) {
      const int last = queue.top().second;
      queue.pop();
      const Step step = steps[last];
      auto& keys = seen[step.node];
      if (static_cast<int>(keys.size()) > classes || !keys.insert(step.key).second) continue;
      if (step.node == node_at(goal)) {
        found.push_back(trace(steps, last));
        continue;
      }
      for (const int next : neighbours(step.node)) {
        const Vector2 a = position(step.node);
        const Vector2 b = position(next);
        const double length_m = step.length_m + (b - a).norm();
        queue.push({length_m + 0.999 * (goal - b).norm(), static_cast<int>(steps.size())});
        steps.push_back({next, last, step.key + key_of<2>(cuts_, a, b), length_m});
      }
    }
    return found;
  }

 private:
  struct Step {
    int node;
    int before;
    SignatureKey key;
    double length_m;
  };
  using Entry = std::pair<double, int>;

  Cuts<2> cuts() const {
    std::vector<Vector2> feet;
    for (const auto& group : static_map_.groups(clearance_m_)) feet.push_back(group.representative);
    return Cuts<2>(feet);
  }
  Vector2 position(int node) const {
    return static_map_.bounds().min() + step_m_ * Vector2(node % columns_, node / columns_);
  }
  int node_at(const Vector2& p) const {
    const Vector2 at = (p - static_map_.bounds().min()) / step_m_;
    return static_cast<int>(std::lround(at.y())) * columns_ + static_cast<int>(std::lround(at.x()));
  }
  std::vector<int> neighbours(int node) const {
    // Knight's moves too, so that lengths are off by 3 % at most; all cleared by the nodes' room.
    std::vector<int> next;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        if (std::max(std::abs(dx), std::abs(dy)) == 0 || (dx % 2 == 0 && dy % 2 == 0)) continue;
        const int x = node % columns_ + dx;
        const int y = node / columns_ + dy;
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_ || !free_[y * columns_ + x]) continue;
        next.push_back(y * columns_ + x);
      }
    }
    return next;
  }
  std::vector<Vector2> trace(const std::vector<Step>& steps, int last) const {
    std::vector<Vector2> path;
    for (int i = last; i >= 0; i = steps[i].before) path.push_back(position(steps[i].node));
    std::reverse(path.begin(), path.end());
    return path;
  }

  const StaticMap& static_map_;
  const double clearance_m_;
  const double step_m_;
  const Cuts<2> cuts_;
  int columns_;
  int rows_;
  std::vector<bool> free_;
};

double length_of(const std::vector<Vector2>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}

/// Bounds of lattice paths and of shortened ones against the shortest of the class.
struct Comparison {
  int paths = 0;
  int beyond_straight = 0;

  void compare(const StaticMap& static_map, unsigned seed) {
    // Lines between free nodes keep less than the nodes; groups are made for what is left.
    const double clearance_m = 0.3;
    const double step_m = 0.1;
    ClassedLattice lattice(static_map, clearance_m, step_m);
    std::mt19937 random(seed);
    const auto place = [&] {
      std::uniform_real_distribution<double> share(0.05, 0.95);
      for (;;) {
        const Vector2 shares(share(random), share(random));
        const Vector2 p = lattice.nearest_node(static_map.bounds().min() +
                                               shares.cwiseProduct(static_map.bounds().sizes()));
        if (lattice.is_free(p)) return p;
      }
    };
    const Vector2 start = place();
    const Vector2 goal = place();
    TravelOptions options = shipped_travel_options();
    options.required_clearance_m = clearance_m - 0.03;  // what a knight's move loses
    const TravelCost cost(static_map, start, {}, options);
    std::vector<Vector2> feet;
    for (const auto& group : static_map.groups(clearance_m)) feet.push_back(group.representative);
    const Cuts<2> cuts(feet);
    for (const auto& shortest : lattice.paths(start, goal, 6)) {
      const double most_m = length_of(shortest) + 1e-6;
      const double raw = least_length_m(shortest, static_map.field());
      const double bound = least_length_m(with_shortcuts(shortest, cost, cuts), static_map.field());
      EXPECT_LE(raw, most_m) << "seed " << seed;
      EXPECT_LE(bound, most_m) << "seed " << seed;
      EXPECT_GE(bound, (goal - start).norm() - 1e-9);
      ++paths;
      beyond_straight += bound > 1.02 * (goal - start).norm() ? 1 : 0;
    }
  }
};

TEST(LengthBound, NeverExceedsTheShortestPathAmongCircles) {
  Comparison comparison;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.5, 7.5), y(0.5, 5.5), radius(0.05, 0.5);
    std::vector<Obstacle> circles;
    for (int i = 0; i < 9; ++i) {
      const double at = x(random);
      circles.push_back(Circle{{at, y(random)}, radius(random)});
    }
    comparison.compare(PrimitiveStaticMap(std::make_shared<PrimitiveField<2>>(circles, 2.0),
                                          {Vector2(0.0, 0.0), Vector2(8.0, 6.0)}),
                       seed);
  }
  EXPECT_GT(comparison.paths, 250);
  EXPECT_GT(comparison.beyond_straight, comparison.paths / 4);
}

TEST(LengthBound, NeverExceedsTheShortestPathOnMaps) {
  Comparison comparison;
  for (int seed = 1; seed <= 60; ++seed) {
    OccupancyGrid grid = random_world(seed, 12, {-9.0, 0.0}, {-9.0, 0.0}, 0.0);
    fill_box(grid, {4.0, 0.5 * (seed % 6)}, {4.1, 0.5 * (seed % 6) + 2.0});
    comparison.compare(GridStaticMap(occupied_field(grid)), seed);
  }
  EXPECT_GT(comparison.paths, 250);
  EXPECT_GT(comparison.beyond_straight, comparison.paths / 4);
}

TEST(LengthBound, KnowsTheDetourRoundAWall) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {3.95, 0.0}, {4.05, 5.0});
  const auto static_map = static_map_of(grid);
  const Vector2 start(2.0, 1.0);
  const Vector2 goal(6.0, 1.0);
  TravelOptions options = shipped_travel_options();
  options.preferred_clearance_m = options.required_clearance_m;
  const TravelCost cost(*static_map, start, {}, options);
  const GridPath lattice = find_grid_path(*static_map, start, goal, cost, 0.05);
  ASSERT_EQ(lattice.outcome, GridPath::Outcome::kFound);
  const auto path = with_shortcuts(lattice.points, cost, Cuts<2>({}));
  const double bound = least_length_m(path, static_map->field());
  EXPECT_LT(bound, length_of(path));
  // To the wall's tip and back, whereas the path keeps off it.
  EXPECT_GT(bound, 0.9 * length_of(path));
  EXPECT_NEAR(bound, 2.0 * std::hypot(2.0, 4.0), 0.1);
}

/// Wherever the tip of it is: also midway between obstacles, where distances have no gradient.
TEST(LengthBound, ASpikeThatWindsAboutNothingIsNoReasonToGoFarther) {
  int spikes = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    const auto field = occupied_field(random_world(seed, 14, {-9.0, 0.0}, {-9.0, 0.0}, 0.0));
    std::vector<Vector2> solid;
    for (int y = 0; y < field->rows(); ++y) {
      for (int x = 0; x < field->columns(); ++x)
        if (field->at_corner(x, y) <= 0.0) solid.push_back(field->corner(x, y));
    }
    const Cuts<2> cuts(solid);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.5, 7.5), y(0.5, 5.5), aside(-0.1, 0.1);
    for (int round = 0; round < 2000; ++round) {
      const Vector2 start(x(random), y(random));
      const Vector2 goal = start + Vector2(aside(random), aside(random));
      const Vector2 tip(x(random), y(random));
      if (signature_of<2>(cuts, {start, tip, goal, start}) != Signature(solid.size(), 0)) continue;
      bool is_free = true;
      for (double share = 0.0; share <= 1.0 && is_free; share += 0.01) {
        is_free = field->distance_bound(start + share * (tip - start)) > 0.05 &&
                  field->distance_bound(goal + share * (tip - goal)) > 0.05;
      }
      if (!is_free) continue;
      ++spikes;
      ASSERT_LE(least_length_m({start, tip, goal}, *field), (goal - start).norm() + 1e-9)
          << seed << ": " << start.transpose() << " by way of " << tip.transpose();
    }
  }
  EXPECT_GT(spikes, 1000);
}

TEST(LengthBound, IsTheStraightLineWhereNothingIsInTheWay) {
  const PrimitiveField<2> none({}, 1.0);
  EXPECT_DOUBLE_EQ(least_length_m({{0.0, 0.0}, {4.0, 3.0}}, none), 5.0);
  EXPECT_DOUBLE_EQ(least_length_m({{0.0, 0.0}, {0.0, 3.0}, {4.0, 3.0}}, none), 5.0);
  const PrimitiveField<2> aside({Circle{{2.0, 8.0}, 1.0}}, 1.0);
  EXPECT_DOUBLE_EQ(least_length_m({{0.0, 0.0}, {0.0, 3.0}, {4.0, 3.0}}, aside), 5.0);
}

TEST(LengthBound, OfALoopReachesRoundTheObstacle) {
  const PrimitiveField<2> post({Circle{{0.0, 0.0}, 1.0}}, 1.0);
  const std::vector<Vector2> loop = {{2.0, 0.0}, {0.0, 2.0}, {-2.0, 0.0}, {0.0, -2.0}, {2.0, 0.0}};
  EXPECT_NEAR(least_length_m(loop, post), 6.0, 1e-9);
}

}  // namespace
}  // namespace mocha
