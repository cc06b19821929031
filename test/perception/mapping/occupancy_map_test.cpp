#include "perception/mapping/occupancy_map.h"

#include <gtest/gtest.h>

#include "perception/room.h"
#include "perception/shipped_options.h"
#include "perception/tracking/peer_tracks.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

const StartGround kJackalStarts(load_robot_model("config", "jackal"));

int8_t cell_at(const OccupancyGrid& grid, const Vector2& p) {
  const Vector2 at = (p - grid.origin) / grid.resolution_m;
  const int x = static_cast<int>(std::floor(at.x()));
  const int y = static_cast<int>(std::floor(at.y()));
  return grid.contains(x, y) ? grid.at(x, y) : OccupancyGrid::kUnknown;
}

int count(const OccupancyGrid& grid, int8_t value) {
  return static_cast<int>(std::count(grid.cells.begin(), grid.cells.end(), value));
}

Room furnished() {
  Room room;
  room.circles = {{{2.0, 0.5}, 0.4}, {{-2.0, -1.5}, 0.25}};
  return room;
}

double distance_to_surface(const Room& room, const Vector2& p) {
  double nearest =
      std::min((p - room.low).cwiseAbs().minCoeff(), (p - room.high).cwiseAbs().minCoeff());
  for (const auto& circle : room.circles) {
    nearest = std::min(nearest, std::abs((p - circle.centre).norm() - circle.radius_m));
  }
  return nearest;
}

bool sees(const Room& room, const Vector2& from, const Vector2& p) {
  const Vector2 way = p - from;
  return room.range(from, std::atan2(way.y(), way.x())) > way.norm();
}

class RoomAtResolution : public testing::TestWithParam<double> {};

TEST_P(RoomAtResolution, HasItsWallsWithinOneCell) {
  OccupancyMapOptions options = shipped_map_options();
  options.resolution_m = GetParam();
  OccupancyMap map(options);
  const Room room = furnished();
  const std::vector<Vector2> stations{{0.0, 0.0}, {3.5, -2.0}, {-3.0, 1.5}};
  for (const Vector2& at : stations) map.insert_scan(beams_at(room, {at, 0.0}, 20.0, 3600));
  const OccupancyGrid grid = map.slice(0.5);
  const double cell = GetParam() * std::sqrt(2.0);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Vector2 centre = grid.cell_centre(x, y);
      const bool seen = std::any_of(stations.begin(), stations.end(),
                                    [&](const Vector2& from) { return sees(room, from, centre); });
      if (grid.at(x, y) == OccupancyGrid::kOccupied) {
        EXPECT_LE(distance_to_surface(room, centre), cell) << "nothing at " << centre.transpose();
      } else if (distance_to_surface(room, centre) > cell) {
        if (seen) {
          EXPECT_EQ(grid.at(x, y), OccupancyGrid::kFree) << centre.transpose();
        }
      }
    }
  }
  for (double s = 0.0; s <= 1.0; s += 0.002) {  // no holes in the upper wall
    const Vector2 p(room.low.x() + s * (room.high.x() - room.low.x()), room.high.y() + 1e-6);
    EXPECT_EQ(cell_at(grid, p), OccupancyGrid::kOccupied) << p.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(OccupancyMap, RoomAtResolution, testing::Values(0.025, 0.05, 0.1));

TEST(OccupancyMap, BehindThingsStaysUnknownAndTheBorderToo) {
  OccupancyMap map(shipped_map_options());
  map.insert_scan(beams_at(furnished(), {}));
  const OccupancyGrid grid = map.slice(0.5);
  EXPECT_EQ(cell_at(grid, {2.0, 0.5}), OccupancyGrid::kUnknown) << "inside the column";
  EXPECT_EQ(cell_at(grid, {3.5, 0.9}), OccupancyGrid::kUnknown) << "in its shadow";
  EXPECT_EQ(cell_at(grid, {1.0, -1.0}), OccupancyGrid::kFree);
  for (int x = 0; x < grid.width; ++x) EXPECT_EQ(grid.at(x, 0), OccupancyGrid::kUnknown);
}

TEST(OccupancyMap, WhatLeavesIsCleared) {
  OccupancyMap map(shipped_map_options());
  Room room;
  room.circles = {{{1.5, 0.0}, 0.3}};
  for (int i = 0; i < 10; ++i) map.insert_scan(beams_at(room, {}));
  EXPECT_EQ(cell_at(map.slice(0.0), {1.21, 0.01}), OccupancyGrid::kOccupied);
  room.circles.clear();
  for (int i = 0; i < 10; ++i) map.insert_scan(beams_at(room, {}));
  const OccupancyGrid grid = map.slice(0.0);
  EXPECT_EQ(cell_at(grid, {1.21, 0.01}), OccupancyGrid::kFree);
  EXPECT_EQ(cell_at(grid, {1.5, 0.0}), OccupancyGrid::kFree);
}

TEST(OccupancyMap, BeamsWithoutReturnClearToTheirReach) {
  OccupancyMap map(shipped_map_options());
  map.insert_scan(beams_at(Room(), {}, 2.0));  // a lidar that sees 2 m: nothing there
  const OccupancyGrid grid = map.slice(0.5);
  EXPECT_EQ(count(grid, OccupancyGrid::kOccupied), 0);
  EXPECT_EQ(cell_at(grid, {1.9, 0.0}), OccupancyGrid::kFree);
  EXPECT_EQ(cell_at(grid, {2.2, 0.0}), OccupancyGrid::kUnknown);
  EXPECT_NEAR(count(grid, OccupancyGrid::kFree) * std::pow(grid.resolution_m, 2), M_PI * 4.0, 0.5);
}

TEST(OccupancyMap, OneScanDoesNotEraseWhatItHit) {
  OccupancyMap map(shipped_map_options());
  std::vector<Beam> beams;
  for (int i = 0; i < 50; ++i) {  // many pass the cell in which one ends
    beams.push_back({{0.0, 0.02, 0.2}, {3.0, 0.02, 0.2}, BeamEnd::kMiss, 0.0});
  }
  beams.insert(beams.begin() + 10, {{0.0, 0.02, 0.2}, {1.52, 0.02, 0.2}, BeamEnd::kHit, 0.0});
  map.insert_scan(beams);
  EXPECT_EQ(cell_at(map.slice(0.0), {1.52, 0.02}), OccupancyGrid::kOccupied);
}

TEST(OccupancyMap, IgnoredHitsClearUpToShortlyBeforeTheirEnd) {
  OccupancyMap map(shipped_map_options());
  map.insert_scan({{{0.0, 0.02, 0.2}, {1.52, 0.02, 0.2}, BeamEnd::kHit, 0.0}});
  for (int i = 0; i < 30; ++i) {
    map.insert_scan({{{0.0, 0.02, 0.2}, {1.52, 0.02, 0.2}, BeamEnd::kIgnored, 0.0},
                     {{0.0, 0.52, 0.2}, {1.52, 0.52, 0.2}, BeamEnd::kIgnored, 0.0}});
  }
  const OccupancyGrid grid = map.slice(0.5);
  EXPECT_EQ(cell_at(grid, {1.52, 0.02}), OccupancyGrid::kOccupied) << "neither added nor erased";
  EXPECT_EQ(cell_at(grid, {1.52, 0.52}), OccupancyGrid::kUnknown);
  EXPECT_EQ(cell_at(grid, {1.38, 0.52}), OccupancyGrid::kFree);
}

TEST(OccupancyMap, TheRobotStandsOnFreeGround) {
  OccupancyMap map(shipped_map_options());
  map.insert_scan({{{1.0, 0.0, 0.2}, {0.22, 0.0, 0.2}, BeamEnd::kHit, 0.0}});
  map.see_robot({{0.0, 0.0}, 0.5 * M_PI}, kJackalStarts, {});
  const OccupancyGrid grid = map.slice(0.5);
  EXPECT_EQ(cell_at(grid, {-0.1, 0.2}), OccupancyGrid::kFree) << "under the body";
  EXPECT_EQ(cell_at(grid, {0.0, -0.33}), OccupancyGrid::kFree)
      << "behind it, where it sees nothing";
  EXPECT_EQ(cell_at(grid, {0.0, 0.36}), OccupancyGrid::kUnknown) << "ahead, what it will see";
  EXPECT_EQ(cell_at(grid, {0.0, -kJackalStarts.reach_m() - 0.02}), OccupancyGrid::kUnknown);
  EXPECT_EQ(cell_at(grid, {0.22, 0.0}), OccupancyGrid::kOccupied) << "only what is unknown";
}

TEST(OccupancyMap, TheRobotDoesNotStartInWalls) {
  OccupancyMap map(shipped_map_options());
  // It looks ahead along x; a wall to its right goes on where it does not see.
  const BlindWall wall{{-0.23, -0.23}, {-1.0, 0.0}, {0.0, -1.0}};
  const BlindWall across{{-0.2, 0.2}, {0.0, -1.0}, {-1.0, 0.0}};
  map.see_robot({{0.0, 0.0}, 0.0}, kJackalStarts, {wall, across});
  const OccupancyGrid grid = map.slice(0.5);
  EXPECT_EQ(cell_at(grid, {-0.26, -0.26}), OccupancyGrid::kUnknown);
  EXPECT_EQ(cell_at(grid, {-0.4, 0.0}), OccupancyGrid::kUnknown);
  EXPECT_EQ(cell_at(grid, {-0.22, 0.0}), OccupancyGrid::kFree) << "the body is there";
  EXPECT_EQ(cell_at(grid, {0.26, -0.2}), OccupancyGrid::kFree) << "beside what was seen";
}

TEST(OccupancyMap, UnderTheBodyIsNothingElse) {
  OccupancyMap map(shipped_map_options());
  for (const double x : {0.22, 0.28})
    map.insert_scan({{{1.0, 0.02, 0.2}, {x, 0.02, 0.2}, BeamEnd::kHit, 0.0},
                     {{1.0, 0.32, 0.2}, {x, 0.32, 0.2}, BeamEnd::kHit, 0.0}});
  map.clear_body({{0.0, 0.0}, 0.0}, load_robot_model("config", "jackal").footprint);
  const OccupancyGrid grid = map.slice(0.5);
  EXPECT_EQ(cell_at(grid, {0.22, 0.02}), OccupancyGrid::kFree);
  EXPECT_EQ(cell_at(grid, {0.28, 0.02}), OccupancyGrid::kOccupied) << "before it";
  EXPECT_EQ(cell_at(grid, {0.22, 0.32}), OccupancyGrid::kOccupied) << "beside it";
  EXPECT_NO_THROW(map.clear_body({{NAN, 0.0}, 0.0}, Footprint::disc(0.3)));
}

TEST(OccupancyMap, TheRobotStartsOnce) {
  OccupancyMap map(shipped_map_options());
  map.see_robot({{0.0, 0.0}, 0.0}, kJackalStarts, {});
  const std::uint64_t version = map.version();
  map.see_robot({{0.2, 0.0}, 0.0}, kJackalStarts, {});
  EXPECT_EQ(map.version(), version) << "it went on";
  map.see_robot({{2.0, 0.0}, 0.0}, kJackalStarts, {});
  EXPECT_EQ(cell_at(map.slice(0.5), {2.0, 0.1}), OccupancyGrid::kFree) << "it was carried";
}

TEST(OccupancyMap, ClearingADiscLeavesTheRest) {
  OccupancyMap map(shipped_map_options());
  const Room room = furnished();
  for (int i = 0; i < 5; ++i) map.insert_scan(beams_at(room, {}));
  map.clear_disc({2.0, 0.5}, 0.5);
  const OccupancyGrid grid = map.slice(0.5);
  for (double angle = 0.0; angle < 6.2; angle += 0.1) {
    const Vector2 p = Vector2(2.0, 0.5) + 0.4 * Vector2(std::cos(angle), std::sin(angle));
    EXPECT_NE(cell_at(grid, p), OccupancyGrid::kOccupied);
  }
  EXPECT_EQ(cell_at(grid, {-1.845, -1.305}), OccupancyGrid::kOccupied) << "the other column";
}

TEST(OccupancyMap, OnlyPointsInTheHeightBandAreObstacles) {
  OccupancyMap map(shipped_map_options());  // band 0.05 m to 1 m
  const Vector3 camera(0.0, 0.02, 0.6);
  const auto see = [&](double x, double y, double z) {
    return Beam{camera, {x, y, z}, BeamEnd::kHit, 0.0};
  };
  map.insert_points({see(2.02, 0.02, 0.5), see(2.02, 0.52, 0.01), see(2.02, -0.52, 1.4),
                     see(1.02, 1.52, 0.07), see(1.02, -1.52, 0.98)});
  const OccupancyGrid grid = map.slice(0.5);
  EXPECT_EQ(count(grid, OccupancyGrid::kOccupied), 3);
  EXPECT_EQ(cell_at(grid, {2.02, 0.02}), OccupancyGrid::kOccupied);
  EXPECT_NE(cell_at(grid, {2.02, 0.52}), OccupancyGrid::kOccupied) << "the floor";
  EXPECT_NE(cell_at(grid, {2.02, -0.52}), OccupancyGrid::kOccupied) << "the lintel";
  EXPECT_EQ(cell_at(grid, {1.02, 1.52}), OccupancyGrid::kOccupied);
  EXPECT_EQ(cell_at(grid, {1.02, 0.27}), OccupancyGrid::kFree) << "on the way to the floor";
  EXPECT_EQ(cell_at(grid, {0.51, -0.12}), OccupancyGrid::kFree) << "on the way up, in the band";
  EXPECT_EQ(cell_at(grid, {1.52, -0.39}), OccupancyGrid::kUnknown) << "above the band";
  EXPECT_EQ(map.occupied_voxels().size(), 3u);
}

TEST(OccupancyMap, FreeSpaceAtOneHeightDoesNotHideAnObstacleAtAnother) {
  OccupancyMap map(shipped_map_options());
  map.insert_points({{{0.0, 0.02, 0.8}, {1.02, 0.02, 0.8}, BeamEnd::kHit, 0.0}});
  for (int i = 0; i < 20; ++i) {
    map.insert_scan({{{0.0, 0.02, 0.2}, {3.0, 0.02, 0.2}, BeamEnd::kMiss, 0.0}});
  }
  EXPECT_EQ(cell_at(map.slice(0.0), {1.02, 0.02}), OccupancyGrid::kOccupied) << "a table top";
  EXPECT_EQ(cell_at(map.slice(0.0), {2.02, 0.02}), OccupancyGrid::kFree);
}

TEST(OccupancyMap, GrowsInAllDirectionsAndKeepsWhatItKnew) {
  OccupancyMap map(shipped_map_options());
  const Room room = furnished();
  map.insert_scan(beams_at(room, {}));
  const OccupancyGrid before = map.slice(0.0);
  for (const Vector2& far : {Vector2(-60.0, 3.0), Vector2(70.0, -80.0), Vector2(0.0, 90.0)}) {
    map.insert_scan({{{far.x(), far.y(), 0.2}, {far.x() + 1.0, far.y(), 0.2}, BeamEnd::kHit, 0.0}});
  }
  const OccupancyGrid after = map.slice(0.0);
  EXPECT_EQ(count(after, OccupancyGrid::kOccupied), count(before, OccupancyGrid::kOccupied) + 3);
  for (int y = 0; y < before.height; ++y) {
    for (int x = 0; x < before.width; ++x) {
      EXPECT_EQ(cell_at(after, before.cell_centre(x, y)), before.at(x, y));
    }
  }
}

TEST(OccupancyMap, RefusesWhatItCannotHold) {
  OccupancyMap map(shipped_map_options());
  map.insert_scan(beams_at(Room(), {}));
  const std::uint64_t version = map.version();
  const auto beam = [](double x) {
    return std::vector<Beam>{{{0.0, 0.0, 0.2}, {x, 0.0, 0.2}, BeamEnd::kHit, 0.0}};
  };
  EXPECT_THROW(map.insert_scan(beam(5000.0)), MapError);
  EXPECT_NO_THROW(map.insert_scan(beam(std::nan(""))));
  EXPECT_NO_THROW(map.insert_scan(beam(1e30)));
  EXPECT_NO_THROW(map.insert_points(beam(INFINITY)));
  EXPECT_EQ(map.version(), version);
  OccupancyMapOptions options = shipped_map_options();
  options.resolution_m = 0.0;
  EXPECT_THROW(OccupancyMap{options}, std::invalid_argument);
  options = shipped_map_options();
  options.scan_height_m = 2.0;
  EXPECT_THROW(OccupancyMap{options}, std::invalid_argument);
}

TEST(OccupancyMap, PlacesThatNoMapHoldsChangeNothing) {
  OccupancyMap map(shipped_map_options());
  map.insert_scan(beams_at(Room(), {}));
  const std::uint64_t version = map.version();
  for (const double odd : {double{NAN}, double{INFINITY}, -1e300, 1e30, 1e9, -5000.0}) {
    EXPECT_THROW(map.see_robot({{odd, 0.0}, 0.0}, kJackalStarts, {}), MapError) << odd;
    EXPECT_THROW(map.see_robot({{0.0, odd}, 0.0}, kJackalStarts, {}), MapError) << odd;
    EXPECT_NO_THROW(map.clear_disc({odd, 0.0}, 0.4)) << odd;
    EXPECT_NO_THROW(map.clear_disc({0.0, odd}, 0.4)) << odd;
  }
  EXPECT_EQ(map.version(), version);
}

TEST(OccupancyMap, VersionChangesWithTheSliceOnly) {
  OccupancyMap map(shipped_map_options());
  const auto beams = beams_at(Room(), {});
  map.insert_scan(beams);
  const std::uint64_t first = map.version();
  map.insert_scan(beams);
  EXPECT_EQ(map.version(), first);
  map.clear();
  EXPECT_NE(map.version(), first);
  EXPECT_EQ(count(map.slice(0.5), OccupancyGrid::kUnknown),
            map.slice(0.5).width * map.slice(0.5).height);
}

TEST(OccupancyMap, TeamMatesDoNotBecomeWalls) {
  OccupancyMap map(shipped_map_options());
  PeerTracks peers(0.15, 1.0);
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  const Vector2 start(1.5, -1.0);
  const double duration = 4.0;  // rest to rest over 2 m
  piece.col(0) = start;
  piece.col(3) = Vector2(0.0, 20.0);
  piece.col(4) = Vector2(0.0, -30.0);
  piece.col(5) = Vector2(0.0, 12.0);
  const auto motion = std::make_shared<Motion>(
      10.0, std::vector<Phase>{DrivePhase{1, PlanarPath({piece}, {duration})}});
  Room room;
  for (double t = 10.0; t < 15.0; t += 0.1) {
    peers.update(t, {{"ugv2", {1, 7}, motion, 0.3, test::kRoverBraking}});
    room.circles = {{motion->at(t).pose.position, 0.25}};
    auto beams = beams_at(room, {});
    for (Beam& beam : beams) beam.time_s = t;
    EXPECT_GT(peers.ignore_peers(beams), 10);
    map.insert_scan(beams);
    const OccupancyGrid grid = map.slice(0.5);
    for (double y = -1.5; y < 2.0; y += 0.05) {
      for (double x = 1.0; x < 2.0; x += 0.05) {
        ASSERT_NE(cell_at(grid, {x, y}), OccupancyGrid::kOccupied) << t << ": " << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace mocha
