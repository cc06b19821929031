#include "topology/roadmaps/map_skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "topology/grid_world.h"
#include "topology/paths/class_search.h"
#include "topology/shipped_options.h"

namespace mocha {
namespace {

const Vector2 kStart(0.5, 0.5);
const Vector2 kGoal(7.5, 5.5);

/// A map with its skeleton, and a way on it.
struct Found {
  explicit Found(const OccupancyGrid& grid, const std::vector<BlockedDisc>& blocked = {},
                 const Vector2& start = kStart, const Vector2& goal = kGoal)
      : static_map(static_map_of(grid)),
        cost(*static_map, start, blocked, shipped_travel_options()),
        skeleton(static_map->skeleton(cost.options())) {
    EXPECT_TRUE(skeleton->complete(cost, [] { return false; }));
    roadmap = skeleton->roadmap(cost, goal);
    std::vector<Vector2> obstacles = skeleton->obstacles();
    for (const BlockedDisc& disc : blocked) obstacles.push_back(disc.centre);
    cuts = Cuts<2>(obstacles);
    paths = shortest_classes(roadmap, cuts, {24, 3.0});
  }

  /// Of how many ways to pass each obstacle on either side there is a path, without a loop about
  /// any.
  int sides() const {
    std::set<Signature> passed;
    for (const ClassPath<2>& path : paths) {
      const Signature signature = signature_of<2>(cuts, path.points);
      if (std::all_of(signature.begin(), signature.end(), [](int n) { return n == 0 || n == -1; }))
        passed.insert(signature);
    }
    return static_cast<int>(passed.size());
  }

  std::shared_ptr<const StaticMap> static_map;
  TravelCost cost;
  std::shared_ptr<const MapSkeleton> skeleton;
  Roadmap<2> roadmap;
  Cuts<2> cuts{{}};
  std::vector<ClassPath<2>> paths;
};

TEST(MapSkeleton, ReachesWhatTheLatticeReaches) {
  int reached = 0;
  int much_dearer = 0;
  double mean_dearer = 0.0;
  for (int seed = 0; seed < 300; ++seed) {
    const OccupancyGrid grid = random_world(seed, 20 + seed % 40, kStart, kGoal, 0.4);
    const Found found(grid);
    const auto path =
        find_path_on_grid(occupied_field(grid), kStart, kGoal, {}, shipped_travel_options());
    const bool reaches = path.outcome == GridPath::Outcome::kFound;
    EXPECT_EQ(!found.paths.empty(), reaches) << seed;
    if (!reaches || found.paths.empty()) continue;
    ++reached;
    for (const ClassPath<2>& way : found.paths)
      EXPECT_LT(cost_of(way.points, found.cost), TravelCost::kInfinity) << seed;
    // The lattice's is no shortest one either.
    const double dearer = cost_of(found.paths.front().points, found.cost) / path.cost;
    EXPECT_LT(dearer, 1.5) << seed;
    if (dearer > 1.25) ++much_dearer;
    mean_dearer += dearer;
  }
  EXPECT_LT(mean_dearer / reached, 1.12);
  // Which worlds these are depends on how a processor's sums are rounded.
  EXPECT_LT(much_dearer, 0.05 * reached);
  EXPECT_GT(reached, 110);
  EXPECT_LT(reached, 280);
}

TEST(MapSkeleton, CostsAreThoseOfTheEdges) {
  const Found found(random_world(3, 25, kStart, kGoal, 0.4));
  for (const auto& edge : found.roadmap.edges) {
    std::vector<Vector2> line = {found.roadmap.nodes[edge.from].position};
    line.insert(line.end(), edge.between.begin(), edge.between.end());
    line.push_back(found.roadmap.nodes[edge.to].position);
    // The costs of lines are sums over other places.
    EXPECT_NEAR(edge.length_m, cost_of(line, found.cost), 0.01 + 0.02 * edge.length_m);
  }
}

TEST(MapSkeleton, PassesPillarsAndDiscsOnEitherSide) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {2.0, 2.0}, {2.4, 4.0});
  fill_box(grid, {5.0, 2.5}, {5.2, 4.5});
  EXPECT_EQ(Found(grid).sides(), 4);
  EXPECT_EQ(Found(grid, {{{3.7, 3.2}, 0.7}}).sides(), 8);
}

TEST(MapSkeleton, TilesFitTogetherWhereADiscIsNearABorder) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {60.0, 3.0});
  fill_box(grid, {0.0, 0.0}, {60.0, 0.9});
  fill_box(grid, {0.0, 2.3}, {60.0, 3.0});
  const double border_m = 9 * 64 * 0.05;
  for (const double off_m : {-0.3, -0.2, -0.15, -0.11, -0.06, 0.0, 0.04, 0.2}) {
    const Found found(grid, {{{border_m + off_m, 1.6}, 0.1}}, {0.6, 1.6}, {59.4, 1.6});
    EXPECT_EQ(found.sides(), 2) << off_m;
  }
}

TEST(MapSkeleton, LeadsOutOfWhereTheStartIsNarrow) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {0.0, 0.0}, {8.0, 0.2});  // the start is closer to this wall than required
  EXPECT_FALSE(Found(grid, {}, {1.0, 0.4}).paths.empty());
  EXPECT_TRUE(Found(grid, {}, {1.0, 0.1}).paths.empty());
}

TEST(MapSkeleton, TellsObstaclesApartByGapsOfHalfTheRobot) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {2.0, 1.0}, {2.4, 2.8});
  fill_box(grid, {2.0, 3.0}, {2.4, 5.0});  // 0.2 m apart
  fill_box(grid, {5.0, 1.0}, {5.4, 2.7});
  fill_box(grid, {5.0, 3.2}, {5.4, 5.0});  // 0.5 m apart
  const Found found(grid);
  EXPECT_EQ(found.skeleton->obstacles().size(), 3u);
  for (const Vector2& obstacle : found.skeleton->obstacles())
    EXPECT_LE(found.static_map->field().sample(obstacle).distance_m, 0.0);
}

TEST(MapSkeleton, RepairedIsAsIfMadeAnew) {
  const OccupancyGrid before = random_world(7, 25, kStart, kGoal, 0.4);
  OccupancyGrid after = before;
  fill_disc(after, {4.0, 4.5}, 0.3, OccupancyGrid::kOccupied);
  fill_disc(after, {3.5, 4.0}, 0.3, OccupancyGrid::kFree);
  const auto field = occupied_field(after);
  const auto field_before = occupied_field(before);
  CornerWindow changed{field->columns(), field->rows(), 0, 0};
  for (int y = 0; y < field->rows(); ++y) {
    for (int x = 0; x < field->columns(); ++x) {
      if (field->at_corner(x, y) == field_before->at_corner(x, y)) continue;
      changed = {std::min(changed.x0, x), std::min(changed.y0, y), std::max(changed.x1, x),
                 std::max(changed.y1, y)};
    }
  }
  const Found old(before);
  const Found fresh(after);
  SkeletonTiles tiles = old.skeleton->tiles();
  const MapSkeleton not_repaired(field, tiles);
  tiles.forget(changed);
  const MapSkeleton repaired(field, tiles);
  for (const MapSkeleton* each : {&not_repaired, &repaired})
    ASSERT_TRUE(each->complete(fresh.cost, [] { return false; }));
  EXPECT_EQ(repaired.obstacles(), fresh.skeleton->obstacles());
  const Roadmap<2> roadmap = repaired.roadmap(fresh.cost, kGoal);
  ASSERT_EQ(roadmap.edges.size(), fresh.roadmap.edges.size());
  for (std::size_t i = 0; i < roadmap.edges.size(); ++i) {
    EXPECT_EQ(roadmap.edges[i].between, fresh.roadmap.edges[i].between);
    EXPECT_EQ(roadmap.edges[i].length_m, fresh.roadmap.edges[i].length_m);
  }
  EXPECT_NE(not_repaired.roadmap(fresh.cost, kGoal).edges.size(), fresh.roadmap.edges.size());
}

}  // namespace
}  // namespace mocha
