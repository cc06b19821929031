#include "perception/localization/scan_fit.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

/// A street along x with a wall at y = 1 m, known up to x = 3 m.
LikelihoodField street() {
  OccupancyGrid grid;
  grid.resolution_m = 0.05;
  grid.width = 80;
  grid.height = 40;
  grid.cells.assign(80 * 40, OccupancyGrid::kUnknown);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 60; ++x) grid.at(x, y) = OccupancyGrid::kFree;
  for (int x = 0; x < 60; ++x) grid.at(x, 20) = OccupancyGrid::kOccupied;
  return {grid, 1.0};
}

TEST(ScanFitTest, TellsWhatTheMapExplains) {
  const LikelihoodField walls = street();
  ScanHits scan;
  scan.hits = {{0.5, 1.02},   // the wall
               {0.8, 0.98},   // the wall
               {0.4, 0.3},    // a person
               {0.1, 1.6},    // behind the wall
               {2.8, -0.1}};  // not seen before
  const ScanFit fit = fit_of(scan, {{0.5, 0.02}, 0.0}, walls, 0.1);
  EXPECT_EQ(fit.on_wall, 2);
  EXPECT_EQ(fit.in_free, 1);
  EXPECT_EQ(fit.behind, 1);
  EXPECT_EQ(fit.unknown, 1);
  EXPECT_EQ(fit.hits(), 5);
  EXPECT_DOUBLE_EQ(fit.quality(), 0.5);
}

TEST(ScanFitTest, SeesFromWhereTheRobotStands) {
  const LikelihoodField walls = street();
  ScanHits scan;
  scan.sensor = {0.1, 0.0};
  scan.hits = {{0.6, 0.0}, {0.6, 0.2}, {0.58, -0.2}};
  const Pose upwards{{1.0, 0.42}, M_PI_2};
  EXPECT_EQ(fit_of(scan, upwards, walls, 0.1).on_wall, 3);
  EXPECT_EQ(fit_of(scan, {{1.0, 0.2}, M_PI_2}, walls, 0.1).in_free, 3);
}

TEST(ScanFitTest, NothingSeenExplainsNothing) {
  EXPECT_EQ(fit_of({}, {{1.0, 0.4}, 0.0}, street(), 0.1).quality(), 0.0);
}

}  // namespace
}  // namespace mocha
