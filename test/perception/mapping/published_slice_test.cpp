#include "perception/mapping/published_slice.h"

#include <gtest/gtest.h>

#include <random>

#include "perception/shipped_options.h"

namespace mocha {
namespace {

constexpr double kBorder_m = 0.5;

std::vector<Beam> beams_to(const std::vector<Vector2>& ends, BeamEnd kind = BeamEnd::kHit) {
  std::vector<Beam> beams;
  for (const Vector2& end : ends)
    beams.push_back({{0.01, 0.01, 0.2}, {end.x(), end.y(), 0.2}, kind, 0.0});
  return beams;
}

struct PublishedSliceTest : ::testing::Test {
  PublishedSliceTest() {
    map.insert_scan(beams_to({{-5.0, -5.0}, {5.0, -5.0}, {5.0, 5.0}, {-5.0, 5.0}}));
  }

  std::int8_t at(const PublishedSlice& slice, const Vector2& place) const {
    const Vector2 cell = (place - slice.grid().origin) / slice.grid().resolution_m;
    return slice.grid().at(static_cast<int>(cell.x()), static_cast<int>(cell.y()));
  }

  OccupancyMap map{shipped_map_options()};
};

TEST_F(PublishedSliceTest, IsTheSliceAtFirst) {
  PublishedSlice slice;
  EXPECT_TRUE(slice.update(map, kBorder_m).whole);
  const OccupancyGrid expected = map.slice(kBorder_m);
  EXPECT_EQ(slice.grid().origin, expected.origin);
  EXPECT_EQ(slice.grid().width, expected.width);
  EXPECT_EQ(slice.grid().cells, expected.cells);
  EXPECT_FALSE(slice.update(map, kBorder_m).whole);
  EXPECT_TRUE(slice.update(map, kBorder_m).windows.empty());
}

TEST_F(PublishedSliceTest, WhoHasTheFormerSliceHasTheNewOneByItsChanges) {
  PublishedSlice slice;
  slice.update(map, kBorder_m);
  OccupancyGrid held = slice.grid();
  std::mt19937 random(3);
  const auto somewhere = [&] { return random() % 1000 * 0.01 - 5.0; };
  for (int i = 0; i < 60; ++i) {
    map.insert_scan(beams_to({{somewhere(), somewhere()}, {somewhere(), somewhere()}}));
    if (i % 3 == 0) continue;  // changes pile up
    const PublishedSlice::Change change = slice.update(map, kBorder_m);
    ASSERT_FALSE(change.whole);
    for (const CornerWindow& window : change.windows) apply(cut_out(slice.grid(), window), held);
    EXPECT_EQ(held.cells, slice.grid().cells);
    EXPECT_EQ(held.cells, map.slice(kBorder_m).cells);
  }
}

TEST_F(PublishedSliceTest, ChangesFarApartAreTwoWindows) {
  PublishedSlice slice;
  slice.update(map, kBorder_m);
  map.clear_disc({-5.0, -5.0}, 0.2);
  map.clear_disc({5.0, 5.0}, 0.2);
  const PublishedSlice::Change change = slice.update(map, kBorder_m);
  ASSERT_EQ(change.windows.size(), 2u);
  for (const CornerWindow& window : change.windows) EXPECT_LE(window.columns(), 8);
}

TEST_F(PublishedSliceTest, GrowsWithRoomToSpareOnlyWhereItMust) {
  PublishedSlice slice;
  slice.update(map, kBorder_m);
  const OccupancyGrid before = slice.grid();
  map.insert_scan(beams_to({{5.31, 0.01}}));
  EXPECT_TRUE(slice.update(map, kBorder_m).whole);
  EXPECT_EQ(slice.grid().origin, before.origin);
  EXPECT_EQ(slice.grid().height, before.height);
  EXPECT_GT(slice.grid().width, before.width + 40);
  EXPECT_EQ(at(slice, {5.31, 0.01}), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(slice, {5.01, 5.01}), OccupancyGrid::kOccupied);
  map.insert_scan(beams_to({{6.51, 0.01}}));
  EXPECT_FALSE(slice.update(map, kBorder_m).whole);
  EXPECT_EQ(at(slice, {6.51, 0.01}), OccupancyGrid::kOccupied);
}

TEST_F(PublishedSliceTest, AMapOfWhichNothingWasKnownDoesNotHoldItsPlace) {
  PublishedSlice slice;
  map.clear();
  EXPECT_TRUE(slice.update(map, 0.0).whole);
  EXPECT_TRUE(slice.grid().cells.empty());
  EXPECT_FALSE(slice.update(map, 0.0).whole);
  map.clear_disc({500.0, 500.0}, 0.2);
  EXPECT_TRUE(slice.update(map, kBorder_m).whole);
  EXPECT_LT(slice.grid().width, 50);
}

TEST_F(PublishedSliceTest, AMapThatIsReplacedIsLaidOutAnew) {
  PublishedSlice slice;
  slice.update(map, kBorder_m);
  map.clear();
  map.insert_scan(beams_to({{-5.0, -5.0}, {5.0, 5.0}}));  // as far as before
  EXPECT_TRUE(slice.update(map, kBorder_m).whole);
  EXPECT_EQ(slice.grid().cells, map.slice(kBorder_m).cells);
}

TEST_F(PublishedSliceTest, ZonesStayOccupiedWhateverIsSeen) {
  PublishedSlice slice;
  slice.mark({Polygon{{{-1.0, 1.0}, {-1.0, 2.0}, {-2.0, 2.0}, {-2.0, 1.0}}},
              Polygon{{{9.0, 1.0}, {9.5, 1.0}, {9.5, 2.0}}}});
  EXPECT_TRUE(slice.update(map, kBorder_m).whole);
  EXPECT_EQ(at(slice, {-1.5, 1.5}), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(slice, {9.45, 1.05}), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(slice, {8.5, 1.05}), OccupancyGrid::kUnknown);
  for (int i = 0; i < 5; ++i) map.insert_scan(beams_to({{-3.0, 3.0}}));
  EXPECT_FALSE(slice.update(map, kBorder_m).whole);
  EXPECT_EQ(at(slice, {-1.5, 1.5}), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(slice, {-2.5, 2.51}), OccupancyGrid::kFree);
}

TEST_F(PublishedSliceTest, ZonesComeAndGoAsChangesOfTheGrid) {
  PublishedSlice slice;
  slice.update(map, kBorder_m);
  OccupancyGrid held = slice.grid();
  const OccupancyGrid without = held;
  const auto change_to = [&](const std::vector<Polygon>& areas, const Strip& open) {
    slice.mark(areas, open);
    EXPECT_TRUE(slice.marks_changed());
    const PublishedSlice::Change change = slice.update(map, kBorder_m);
    EXPECT_FALSE(slice.marks_changed());
    EXPECT_FALSE(change.whole);
    for (const CornerWindow& window : change.windows) apply(cut_out(slice.grid(), window), held);
    EXPECT_EQ(held.cells, slice.grid().cells);
  };
  const Polygon square{{{-2.0, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {-2.0, 2.0}}};
  const Polygon elsewhere{{{3.0, 3.0}, {4.0, 3.0}, {4.0, 4.0}}};
  change_to({square}, {});
  EXPECT_EQ(at(slice, {0.01, 0.01}), OccupancyGrid::kOccupied);
  change_to({square}, {{{0.0, 0.0}, {3.0, 0.0}}, 0.5});
  EXPECT_NE(at(slice, {1.01, 0.31}), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(slice, {1.01, 0.71}), OccupancyGrid::kOccupied);
  change_to({elsewhere}, {});
  EXPECT_NE(at(slice, {1.01, 0.71}), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(slice, {3.91, 3.51}), OccupancyGrid::kOccupied);
  change_to({}, {});
  EXPECT_EQ(held.cells, without.cells);
}

}  // namespace
}  // namespace mocha
