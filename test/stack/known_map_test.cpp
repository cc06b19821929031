#include "stack/known_map.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <thread>

#include "topology/grid_world.h"
#include "topology/roadmaps/map_skeleton.h"
#include "topology/shipped_options.h"

namespace mocha {
namespace {

using Solid = DistanceField::Solid;

struct KnownMapTest : ::testing::Test {
  KnownMapTest() { fill_disc(grid, {2.0, 2.0}, 0.5, OccupancyGrid::kOccupied); }

  KnownMap map;
  OccupancyGrid grid = free_grid({0.0, 0.0}, {6.0, 4.0});
};

TEST_F(KnownMapTest, UnknownSpaceIsSolidOnlyWhereAskedFor) {
  fill_box(grid, {4.0, 0.0}, {6.0, 4.0}, OccupancyGrid::kUnknown);
  map.take(grid);
  EXPECT_GT(map.field(Solid::kOccupied, {{5.0, 2.0}}, 1.0)->distance_bound({5.0, 2.0}), 2.0);
  EXPECT_EQ(map.field(Solid::kOccupiedOrUnknown, {{5.0, 2.0}}, 1.0)->distance_bound({5.0, 2.0}),
            0.0);
}

TEST_F(KnownMapTest, GrowsToHoldThePoints) {
  map.take(grid);
  const auto field = map.field(Solid::kOccupied, {{-3.0, 9.0}, {1.0, 1.0}}, 2.0);
  EXPECT_LE(field->origin().x(), -5.0 + 0.051);
  EXPECT_GE(field->corner(0, field->rows() - 1).y(), 11.0 - 0.051);
  EXPECT_NEAR(field->distance_bound({3.0, 2.0}), 0.5, 0.05);  // the map is where it was
}

TEST_F(KnownMapTest, FieldsAreKeptWhileTheyServe) {
  map.take(grid);
  const auto first = map.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0);
  EXPECT_EQ(map.field(Solid::kOccupied, {{3.5, 2.0}}, 1.0), first);
  EXPECT_NE(map.field(Solid::kOccupiedOrUnknown, {{3.0, 2.0}}, 1.0), first);
  EXPECT_EQ(map.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0), first);  // both kinds are kept
  const auto wider = map.field(Solid::kOccupied, {{9.0, 2.0}}, 1.0);
  EXPECT_NE(wider, first);
  fill_disc(grid, {4.0, 2.0}, 0.1, OccupancyGrid::kOccupied);
  map.take(grid);
  EXPECT_NE(map.field(Solid::kOccupied, {{9.0, 2.0}}, 1.0), wider);
}

TEST_F(KnownMapTest, PlacesOutOfThisWorldAreLeftOut) {
  map.take(grid);
  for (const double far :
       {1e6, 1e9, 1e300, -1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const auto field = map.field(Solid::kOccupied, {{3.0, 2.0}, {far, 1.0}}, 3.0);
    EXPECT_LT(field->columns(), 1000) << far;
    EXPECT_NEAR(field->distance_bound({3.0, 2.0}), 0.5, 0.05) << far;
  }
}

TEST_F(KnownMapTest, RefusesGridsThatAreNone) {
  map.take(grid);
  EXPECT_THROW(map.take(OccupancyGrid()), std::invalid_argument);
  OccupancyGrid broken = grid;
  broken.cells.pop_back();
  EXPECT_THROW(map.take(broken), std::invalid_argument);
  broken = grid;
  broken.origin.x() = std::nan("");
  EXPECT_THROW(map.take(broken), std::invalid_argument);
  EXPECT_EQ(map.newest().cells, grid.cells);
}

TEST_F(KnownMapTest, RefusesUpdatesThatDoNotFit) {
  EXPECT_THROW(map.take(GridUpdate{0, 0, 1, 1, {0}}), std::invalid_argument) << "of no map";
  map.take(grid);
  const int big = std::numeric_limits<int>::max();
  for (const GridUpdate& odd :
       {GridUpdate{-1, 0, 1, 1, {100}}, GridUpdate{0, grid.height, 1, 1, {100}},
        GridUpdate{grid.width - 1, 0, 2, 1, {100, 100}}, GridUpdate{0, 0, 2, 2, {100}},
        GridUpdate{big, big, 1, 1, {100}}, GridUpdate{1, 1, big, 1, {100}},
        GridUpdate{0, 0, -1, -1, {100}}})
    EXPECT_THROW(map.take(odd), std::invalid_argument);
  EXPECT_EQ(map.newest().cells, grid.cells);
}

void expect_same(const DistanceField& a, const DistanceField& b) {
  ASSERT_EQ(a.columns(), b.columns());
  ASSERT_EQ(a.rows(), b.rows());
  for (int y = 0; y < a.rows(); ++y) {
    for (int x = 0; x < a.columns(); ++x)
      ASSERT_EQ(a.at_corner(x, y), b.at_corner(x, y)) << x << ", " << y;
  }
}

/// A map that grows and changes, as one that is being made, and one that is asked only in the end.
TEST_F(KnownMapTest, RepairsWhatChangesAsIfItWereNew) {
  std::mt19937 random(1);
  OccupancyGrid hall = free_grid({-10.0, -10.0}, {20.0, 15.0});
  fill_box(hall, {0.0, -10.0}, {0.2, 5.0});
  const std::vector<Vector2> points = {{-9.0, -9.0}, {22.0, 9.0}};
  const Vector2 start(-8.0, -8.0);
  const Vector2 goal(18.0, -8.0);
  std::shared_ptr<const DistanceField> last;
  std::shared_ptr<const DistanceField> last_expected;
  for (int step = 0; step < 30; ++step) {
    for (int i = 0; i < 3; ++i) {
      const Vector2 place(random() % 2800 * 0.01 - 9.0, random() % 2400 * 0.01 - 9.5);
      fill_disc(hall, place, 0.05 * (1 + random() % 8),
                random() % 2 == 0 ? OccupancyGrid::kOccupied : OccupancyGrid::kFree);
    }
    for (const Vector2& end : {start, goal}) fill_disc(hall, end, 1.0, OccupancyGrid::kFree);
    if (step == 20) hall = grown_to_hold(hall, {{21.0, 0.0}}, 0.0);
    map.take(hall);
    KnownMap fresh;
    fresh.take(hall);
    const auto static_map = map.static_map(points, 2.0);
    const auto expected = fresh.static_map(points, 2.0);
    for (const Solid solid : {Solid::kOccupied, Solid::kOccupiedOrUnknown})
      expect_same(*map.field(solid, points, 2.0), *fresh.field(solid, points, 2.0));
    const TravelCost cost(*static_map, start, {}, shipped_travel_options());
    const TravelCost fresh_cost(*expected, start, {}, shipped_travel_options());
    const auto skeleton = static_map->skeleton(cost.options());
    const auto fresh_skeleton = expected->skeleton(cost.options());
    ASSERT_TRUE(skeleton->complete(cost, [] { return false; }));
    ASSERT_TRUE(fresh_skeleton->complete(fresh_cost, [] { return false; }));
    EXPECT_EQ(skeleton->obstacles(), fresh_skeleton->obstacles());
    EXPECT_EQ(skeleton->roadmap(cost, goal).edges.size(),
              fresh_skeleton->roadmap(fresh_cost, goal).edges.size());
    // A field that was handed out earlier keeps its values.
    if (last) expect_same(*last, *last_expected);
    last = map.field(Solid::kOccupied, points, 2.0);
    last_expected = fresh.field(Solid::kOccupied, points, 2.0);
  }
}

/// What a random walk of discs changes, as updates of several windows: some are asked for at once,
/// some pile up, some come with a new grid.
TEST_F(KnownMapTest, UpdatesMakeTheSameAsGrids) {
  std::mt19937 random(2);
  OccupancyGrid hall = free_grid({-10.0, -10.0}, {20.0, 15.0});
  const std::vector<Vector2> points = {{-9.0, -9.0}, {22.0, 9.0}};
  map.take(hall);
  for (int step = 0; step < 40; ++step) {
    const Vector2 place(random() % 2800 * 0.01 - 9.0, random() % 2400 * 0.01 - 9.5);
    fill_disc(hall, place, 0.05 * (1 + random() % 8),
              random() % 3 == 0 ? OccupancyGrid::kFree : OccupancyGrid::kOccupied);
    const Vector2 cell = (place - hall.origin) / hall.resolution_m;
    const int x = static_cast<int>(cell.x());
    const int y = static_cast<int>(cell.y());
    if (step % 13 == 12) {
      hall = grown_to_hold(hall, {{21.0 + 0.1 * step, 0.0}}, 0.0);
      map.take(hall);
    } else {
      map.take(cut_out(hall, CornerWindow{x - 10, y - 10, x + 10, y + 10}.within(
                                 {0, 0, hall.width - 1, hall.height - 1})));
    }
    if (step % 4 == 1 || step % 4 == 2) continue;
    KnownMap fresh;
    fresh.take(hall);
    EXPECT_EQ(map.newest().cells, hall.cells);
    for (const Solid solid : {Solid::kOccupied, Solid::kOccupiedOrUnknown})
      expect_same(*map.field(solid, points, 2.0), *fresh.field(solid, points, 2.0));
  }
}

/// To be run with the thread sanitizer, too.
TEST_F(KnownMapTest, OneThreadTakesWhatAnotherAsksFor) {
  map.take(grid);
  std::atomic<bool> ends{false};
  std::thread asking([&] {
    while (!ends) {
      const auto field = map.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0);
      const auto static_map = map.static_map({{3.0, 2.0}}, 1.0);
      EXPECT_LE(field->distance_bound({2.0, 2.0}), 0.0);
      EXPECT_LE(static_map->field().distance_bound({2.0, 2.0}), 0.0);
    }
  });
  for (int i = 0; i < 500; ++i) {
    fill_disc(grid, {4.0, 3.0}, 0.2, i % 2 == 0 ? OccupancyGrid::kOccupied : OccupancyGrid::kFree);
    if (i % 50 == 0)
      map.take(grid);
    else
      map.take(cut_out(grid, {70, 50, 90, 70}));
  }
  ends = true;
  asking.join();
  EXPECT_EQ(map.newest().cells, grid.cells);
}

TEST_F(KnownMapTest, RepairsInPlaceWhatNobodyLooksAt) {
  map.take(grid);
  const DistanceField* before = map.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0).get();
  fill_disc(grid, {4.0, 2.0}, 0.1, OccupancyGrid::kOccupied);
  map.take(grid);
  EXPECT_EQ(map.field(Solid::kOccupied, {{3.0, 2.0}}, 1.0).get(), before);
  EXPECT_EQ(before->distance_bound({4.0, 2.0}), 0.0);
}

}  // namespace
}  // namespace mocha
