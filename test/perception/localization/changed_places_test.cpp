// A robot that knows the office as it once was.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "perception/localization/localisation_scene.h"
#include "perception/localization/scan_localizer.h"

namespace mocha {
namespace {

using State = Localization::State;

constexpr double kWrong_m = 0.3;

World office() {
  World world = one_robot_world("config/worlds/office.yaml", {{2.0, 9.0}, -1.57});
  const std::vector<Circle> more{{{1.0, 11.0}, 0.3}, {{0.6, 8.0}, 0.25},  {{7.2, 11.2}, 0.35},
                                 {{9.2, 10.9}, 0.3}, {{11.2, 7.9}, 0.3},  {{1.0, 2.0}, 0.3},
                                 {{5.5, 3.0}, 0.3},  {{13.5, 2.5}, 0.35}, {{17.2, 8.4}, 0.3}};
  world.circles.insert(world.circles.end(), more.begin(), more.end());
  return world;
}

/// Out of a room, along the corridor and back, and through the room beside it home.
std::vector<Vector2> round_trip() {
  return {{2.0, 6.0}, {10.0, 6.0}, {18.0, 6.0}, {10.0, 6.1}, {6.0, 6.1},
          {6.0, 7.6}, {5.0, 9.9},  {3.0, 10.1}, {2.0, 9.0}};
}

/// What the localiser says of each sweep of a drive.
struct Said {
  State state;
  double off_m;
  Pose truth;
};

/// `blind` may change what is seen of sweep i.
template <class Blind>
std::vector<Said> follow(const OccupancyGrid& map, const std::vector<DriveScan>& drive,
                         const RobotModel& model, Blind blind) {
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map);
  localizer.expect({drive[0].truth, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()});
  std::vector<Said> said;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    ScanHits scan = hits_of(drive[i], model.lidar);
    blind(i, scan);
    const Localization& now = localizer.add(scan, drive[i].odometry);
    said.push_back({now.state, distance_m(now.base.pose, drive[i].truth), drive[i].truth});
  }
  return said;
}

std::vector<Said> follow(const World& mapped, const World& now) {
  const RobotModel& model = mapped.robots[0].model;
  return follow(map_of(drive_through(mapped, round_trip(), 1), model),
                drive_through(now, round_trip(), 2), model, [](std::size_t, ScanHits&) {});
}

std::vector<double> errors_m(const std::vector<Said>& said) {
  std::vector<double> errors;
  for (const Said& each : said)
    if (each.state == State::kLocalized) errors.push_back(each.off_m);
  std::sort(errors.begin(), errors.end());
  return errors;
}

/// Share of the sweeps that were taken where `counts` holds.
template <class Counts>
double localized(const std::vector<Said>& said, Counts counts) {
  double all = 0.0;
  double known = 0.0;
  for (const Said& each : said) {
    if (!counts(each.truth.position)) continue;
    all += 1.0;
    if (each.state == State::kLocalized) known += 1.0;
  }
  return known / all;
}

constexpr auto kAnywhere = [](const Vector2&) { return true; };

TEST(ChangedPlacesTest, AThirdOfTheFurnitureWasMovedAndThreePeopleAreAround) {
  World now = office();
  for (std::size_t i = 0; i < now.circles.size(); i += 3)
    now.circles[i].centre += Vector2(i % 2 == 0 ? 0.9 : -0.8, 0.5);
  now.moving = {along_path(0.25, 0.8, true, {{4.0, 5.6}, {16.0, 6.4}}),
                along_path(0.25, 0.6, true, {{18.0, 5.5}, {9.0, 6.5}}),
                along_path(0.25, 0.5, true, {{1.0, 9.5}, {3.2, 8.0}})};
  const std::vector<Said> said = follow(office(), now);
  const std::vector<double> off_m = errors_m(said);
  EXPECT_GE(localized(said, kAnywhere), 0.9);
  EXPECT_LT(off_m[off_m.size() / 2], 0.03);
  EXPECT_LT(off_m.back(), 0.1);
}

TEST(ChangedPlacesTest, DoorsWereClosed) {
  World now = office();
  for (const double x : {14.0, 18.0}) now.polygons.push_back(box(x - 0.5, 6.95, x + 0.5, 7.05));
  for (const double x : {2.0, 6.0, 10.0, 14.0, 18.0})
    now.polygons.push_back(box(x - 0.5, 4.95, x + 0.5, 5.05));
  const std::vector<Said> said = follow(office(), now);
  EXPECT_GE(localized(said, kAnywhere), 0.95);
  EXPECT_LT(errors_m(said).back(), 0.1);
}

TEST(ChangedPlacesTest, SomebodyStandsInHalfOfTheView) {
  const World world = office();
  const RobotModel& model = world.robots[0].model;
  const OccupancyGrid map = map_of(drive_through(world, round_trip(), 1), model);
  const auto drive = drive_through(world, round_trip(), 2);
  const std::vector<Said> said = follow(map, drive, model, [](std::size_t i, ScanHits& scan) {
    if (i < 60 || i >= 160) return;
    for (Vector2& hit : scan.hits)
      if (hit.y() > 0.0) hit *= 0.4 / hit.norm();
  });
  EXPECT_LT(errors_m(said).back(), 0.15);
  const std::vector<Said> after(said.begin() + 190, said.end());
  EXPECT_GE(localized(after, kAnywhere), 0.99);
}

TEST(ChangedPlacesTest, TheFloorWasRebuiltInPart) {
  World now = office();
  const auto is_east = [](const Vector2& p) { return p.x() > 12.5; };
  now.polygons.erase(std::remove_if(now.polygons.begin(), now.polygons.end(),
                                    [&](const Polygon& wall) {
                                      return std::all_of(wall.corners.begin(), wall.corners.end(),
                                                         is_east) &&
                                             wall.corners[0].x() < 19.9;
                                    }),
                     now.polygons.end());
  now.polygons.push_back(box(13.0, 8.3, 17.0, 8.5));
  now.polygons.push_back(box(14.0, 3.4, 20.0, 3.6));
  now.polygons.push_back(box(16.5, 8.5, 16.7, 12.0));
  const std::vector<Said> said = follow(office(), now);
  EXPECT_LT(errors_m(said).back(), kWrong_m);
  EXPECT_GE(localized(said, [](const Vector2& p) { return p.x() < 9.0; }), 0.95);
}

TEST(ChangedPlacesTest, TheMapEndsOnTheWay) {
  World world = office();
  const RobotModel& model = world.robots[0].model;
  // The room and a look at the corridor.
  OccupancyGrid map = map_of(drive_through(world, {{2.0, 7.6}}, 1), model);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      if (map.cell_centre(x, y).x() > 5.0) map.at(x, y) = OccupancyGrid::kUnknown;
  const std::vector<Said> said =
      follow(map, drive_through(world, round_trip(), 2), model, [](std::size_t, ScanHits&) {});
  const auto is_far = [](const Vector2& p) { return p.x() > 15.0; };
  EXPECT_LT(errors_m(said).back(), kWrong_m);
  EXPECT_EQ(localized(said, is_far), 0.0);
  EXPECT_EQ(said[40].state, State::kLocalized);
  EXPECT_EQ(said.back().state, State::kLocalized);
}

}  // namespace
}  // namespace mocha
