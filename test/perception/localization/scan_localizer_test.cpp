#include "perception/localization/scan_localizer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "perception/localization/localisation_scene.h"

namespace mocha {
namespace {

using State = Localization::State;

/// What a localiser said of a drive.
struct Account {
  std::vector<double> off_m;  // while localised
  std::vector<double> off_rad;
  int localized = 0;
  int scans = 0;
  double first_s = -1.0;  // when it was localised first

  static double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
  }
};

/// Goes on with the drive from sweep `from` to `to`.
Account follow(ScanLocalizer& localizer, const std::vector<DriveScan>& drive,
               const LidarModel& lidar, std::size_t from, std::size_t to) {
  Account account;
  for (std::size_t i = from; i < std::min(to, drive.size()); ++i) {
    const ScanHits scan = hits_of(drive[i], lidar);
    const Localization& now = localizer.add(scan, drive[i].odometry);
    ++account.scans;
    if (now.state != State::kLocalized) continue;
    if (account.localized++ == 0) account.first_s = scan.time_s;
    account.off_m.push_back(distance_m(now.base.pose, drive[i].truth));
    account.off_rad.push_back(turn_rad(now.base.pose, drive[i].truth));
  }
  return account;
}

class ScanLocalizerTest : public testing::TestWithParam<const char*> {
 protected:
  ScanLocalizerTest()
      : world_(one_robot_world("config/worlds/corridor.yaml", {{0.0, 0.0}, 0.0}, GetParam())),
        model_(world_.robots[0].model),
        map_(map_of(drive_through(world_, corridor_path(), 1), model_)),
        drive_(drive_through(world_, corridor_path(), 2)),
        localizer_(shipped_localizer_options(model_)) {
    localizer_.set_map(map_);
  }

  World world_;
  RobotModel model_;
  OccupancyGrid map_;
  std::vector<DriveScan> drive_;
  ScanLocalizer localizer_;
};

TEST_P(ScanLocalizerTest, KnowsWhereItIsAllTheWayWithoutBeingTold) {
  ASSERT_GT(distance_m(drive_.back().odometry, drive_.back().truth), 0.03) << "no drift";
  const Account account = follow(localizer_, drive_, model_.lidar, 0, drive_.size());
  EXPECT_LT(account.first_s, 1.5);
  EXPECT_GE(account.localized, account.scans - 12);
  EXPECT_LT(Account::quantile(account.off_m, 0.5), 0.03);
  EXPECT_LT(Account::quantile(account.off_m, 1.0), 0.1);
  EXPECT_LT(Account::quantile(account.off_rad, 0.5), M_PI / 180.0);
  EXPECT_LT(Account::quantile(account.off_rad, 1.0), 3.0 * M_PI / 180.0);
}

TEST_P(ScanLocalizerTest, RecoversFromBeingCarriedAway) {
  for (std::size_t from : {60, 150, 280}) {
    ScanLocalizer localizer(shipped_localizer_options(model_));
    localizer.set_map(map_);
    const Kidnapping carried = kidnap(drive_, from, 5.0);
    follow(localizer, carried.drive, model_.lidar, 0, carried.when);
    ASSERT_EQ(localizer.localization().state, State::kLocalized);
    // Within half a second the old place is not believed any more; within three the new one is
    // known.
    follow(localizer, carried.drive, model_.lidar, carried.when, carried.when + 5);
    EXPECT_NE(localizer.localization().state, State::kLocalized) << from;
    const Account after =
        follow(localizer, carried.drive, model_.lidar, carried.when + 5, carried.when + 30);
    EXPECT_EQ(localizer.localization().state, State::kLocalized) << from;
    EXPECT_LT(Account::quantile(after.off_m, 1.0), 0.1) << from;
  }
}

TEST_P(ScanLocalizerTest, IsNotConfusedByAnOdometryThatBeginsAnew) {
  follow(localizer_, drive_, model_.lidar, 0, 200);
  std::vector<DriveScan> rest(drive_.begin() + 200, drive_.end());
  const Pose origin = rest[0].odometry;
  for (DriveScan& sweep : rest) {
    sweep.odometry = relative(origin, sweep.odometry);
    sweep.odometry_first = relative(origin, sweep.odometry_first);
  }
  const Account account = follow(localizer_, rest, model_.lidar, 0, 100);
  EXPECT_EQ(account.localized, account.scans);
  EXPECT_LT(Account::quantile(account.off_m, 1.0), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Models, ScanLocalizerTest, testing::Values("rover", "waveshare_rover"));

TEST(ScanLocalizerRefusalTest, NeverBelievesThatItIsInAMapOfAnotherPlace) {
  World here = one_robot_world("config/worlds/five.yaml",
                               load_world("config/worlds/five.yaml", "config").robots[0].start);
  World there = one_robot_world("config/worlds/corridor.yaml", {{0.0, 0.0}, 0.0});
  const RobotModel& model = here.robots[0].model;
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map_of(drive_through(there, corridor_path(), 1), model));
  const auto drive = drive_through(here, {here.robots[0].goal->position}, 2, 20.0);
  const Account account = follow(localizer, drive, model.lidar, 0, drive.size());
  EXPECT_GT(account.scans, 100);
  EXPECT_EQ(account.localized, 0);
}

/// An empty room, 8 m by 5 m, which looks the same after half a turn.
World symmetric_room() {
  World world = one_robot_world("config/worlds/corridor.yaml", {{2.0, 1.5}, 0.3});
  world.circles.clear();
  world.bounds = Eigen::AlignedBox2d(Vector2(0.0, 0.0), Vector2(8.0, 5.0));
  world.polygons = {box(0.0, 0.0, 8.0, 0.2), box(0.0, 4.8, 8.0, 5.0), box(0.0, 0.0, 0.2, 5.0),
                    box(7.8, 0.0, 8.0, 5.0)};
  return world;
}

TEST(ScanLocalizerRefusalTest, DoesNotGuessBetweenTwoPlacesThatLookTheSame) {
  World world = symmetric_room();
  const RobotModel& model = world.robots[0].model;
  const std::vector<Vector2> way{{6.0, 1.5}, {6.0, 3.5}, {2.0, 3.5}};
  const OccupancyGrid map = map_of(drive_through(world, way, 1), model);
  const auto drive = drive_through(world, way, 2);
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map);
  const Account account = follow(localizer, drive, model.lidar, 0, drive.size());
  EXPECT_EQ(account.localized, 0);
  EXPECT_EQ(localizer.localization().state, State::kAmbiguous);
  EXPECT_GE(localizer.localization().places, 2);
}

TEST(ScanLocalizerRefusalTest, TakesAWordWhereTheScansCannotTell) {
  World world = symmetric_room();
  const RobotModel& model = world.robots[0].model;
  const std::vector<Vector2> way{{6.0, 1.5}, {6.0, 3.5}, {2.0, 3.5}};
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map_of(drive_through(world, way, 1), model));
  const auto drive = drive_through(world, way, 2);
  follow(localizer, drive, model.lidar, 0, 30);
  const Pose said{drive[30].truth.position + Vector2(0.5, -0.4), drive[30].truth.yaw_rad + 0.2};
  localizer.expect({said, Eigen::Vector3d(0.25, 0.25, 0.07).asDiagonal()});
  const Account account = follow(localizer, drive, model.lidar, 30, drive.size());
  EXPECT_GE(account.localized, account.scans - 12);
  EXPECT_LT(Account::quantile(account.off_m, 1.0), 0.1);
}

TEST(ScanLocalizerRefusalTest, ACrowdThatHidesTheWallsForAWhileDoesNotConfuseIt) {
  World world = symmetric_room();
  const RobotModel& model = world.robots[0].model;
  const std::vector<Vector2> way{{6.0, 1.5}, {6.0, 3.5}, {2.0, 3.5}};
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map_of(drive_through(world, way, 1), model));
  const auto drive = drive_through(world, way, 2);
  localizer.expect({drive[0].truth, Eigen::Vector3d(0.25, 0.25, 0.07).asDiagonal()});
  follow(localizer, drive, model.lidar, 0, 40);
  ASSERT_EQ(localizer.localization().state, State::kLocalized);
  for (std::size_t i = 40; i < 75; ++i) {
    ScanHits scan = hits_of(drive[i], model.lidar);
    for (std::size_t hit = 0; i < 53 && hit < scan.hits.size(); ++hit) {
      if (hit % 20 < 9) scan.hits[hit] *= 0.5;  // a person before the wall
    }
    const Localization& now = localizer.add(scan, drive[i].odometry);
    EXPECT_EQ(now.state, State::kLocalized) << i << ' ' << now.quality;
    EXPECT_LT(distance_m(now.base.pose, drive[i].truth), 0.1) << i;
    if (i == 50) {
      EXPECT_LT(now.quality, 0.7);
    }
  }
}

TEST(ScanLocalizerRefusalTest, DoesNotTakeAWordThatTheScansContradict) {
  World world = one_robot_world("config/worlds/corridor.yaml", {{0.0, 0.0}, 0.0});
  const RobotModel& model = world.robots[0].model;
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map_of(drive_through(world, corridor_path(), 1), model));
  const auto drive = drive_through(world, corridor_path(), 2);
  localizer.expect({{{9.0, 0.0}, 1.0}, Eigen::Vector3d(0.25, 0.25, 0.07).asDiagonal()});
  const Account account = follow(localizer, drive, model.lidar, 0, 40);
  EXPECT_GT(account.localized, 10);  // it has found the right place for itself
  EXPECT_LT(Account::quantile(account.off_m, 1.0), 0.1);
}

TEST(ScanLocalizerRefusalTest, WithoutMapOrHitsItKnowsNothing) {
  World world = one_robot_world("config/worlds/corridor.yaml", {{0.0, 0.0}, 0.0});
  const RobotModel& model = world.robots[0].model;
  const auto drive = drive_through(world, {{2.0, 0.0}}, 2);
  ScanLocalizer localizer(shipped_localizer_options(model));
  EXPECT_EQ(follow(localizer, drive, model.lidar, 0, 20).localized, 0);
  EXPECT_THROW(localizer.set_map({}), std::invalid_argument);
  localizer.set_map(map_of(drive, model));
  localizer.forget();
  for (int i = 0; i < 30; ++i) localizer.add({0.1 * i, {0.0, 0.0}, {}}, {{0.0, 0.0}, 0.0});
  EXPECT_EQ(localizer.localization().state, State::kLost);
}

TEST(ScanLocalizerRefusalTest, ARobotThatSeesNothingForLongIsLost) {
  World world = one_robot_world("config/worlds/corridor.yaml", {{0.0, 0.0}, 0.0});
  const RobotModel& model = world.robots[0].model;
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map_of(drive_through(world, corridor_path(), 1), model));
  const auto drive = drive_through(world, corridor_path(), 2);
  follow(localizer, drive, model.lidar, 0, 40);
  ASSERT_EQ(localizer.localization().state, State::kLocalized);
  Pose odometry = drive[39].odometry;
  double time_s = drive[39].scan.end_time_s();
  double sigma_m = 0.0;
  for (int i = 0; i < 10; ++i) {
    odometry = composed(odometry, {{0.1, 0.0}, 0.0});
    localizer.add({time_s += 0.1, {0.0, 0.0}, {}}, odometry);
    const double now_m = localizer.localization().base.covariance.trace();
    EXPECT_GT(now_m, sigma_m);
    sigma_m = now_m;
  }
  EXPECT_EQ(localizer.localization().state, State::kLocalized);
  for (int i = 0; i < 6000 && localizer.localization().state == State::kLocalized; ++i) {
    odometry = composed(odometry, {{0.1, 0.0}, 0.0});
    localizer.add({time_s += 0.1, {0.0, 0.0}, {}}, odometry);
  }
  EXPECT_NE(localizer.localization().state, State::kLocalized);
}

/// A corridor, 30 m long, with pillars along it at uneven distances.
World pillared_corridor() {
  World world = one_robot_world("config/worlds/corridor.yaml", {{2.0, 0.0}, 0.0});
  world.circles.clear();
  world.bounds = Eigen::AlignedBox2d(Vector2(-0.5, -1.5), Vector2(30.5, 1.5));
  world.polygons = {box(0.0, -1.2, 30.0, -1.0), box(0.0, 1.0, 30.0, 1.2), box(-0.2, -1.2, 0.0, 1.2),
                    box(30.0, -1.2, 30.2, 1.2)};
  double x = 0.5;
  for (const double gap : {0.5, 0.8, 0.4, 1.1, 0.6, 0.9, 0.5, 1.3, 0.7, 0.4, 1.0, 0.6, 0.8, 1.2,
                           0.5, 0.9, 0.6, 1.1, 0.4, 0.8, 0.7, 1.3, 0.5, 0.6, 1.0, 0.9, 0.4, 0.8}) {
    x += gap;
    world.polygons.push_back(box(x, 0.85, x + 0.2, 1.0));
    world.polygons.push_back(box(x + 0.15, -1.0, x + 0.35, -0.85));
  }
  return world;
}

TEST(ScanLocalizerRefusalTest, ASlipOnALongStepDoesNotEndAtTheWrongPillar) {
  World world = pillared_corridor();
  const RobotModel& model = world.robots[0].model;
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map_of(drive_through(world, {{24.0, 0.0}}, 1), model));
  const auto drive = drive_through(world, {{24.0, 0.0}}, 2);
  // It does not see so far as the ends of the corridor.
  const auto near = [&](std::size_t i) {
    ScanHits scan = hits_of(drive[i], model.lidar);
    scan.hits.erase(std::remove_if(scan.hits.begin(), scan.hits.end(),
                                   [](const Vector2& hit) { return hit.norm() > 4.0; }),
                    scan.hits.end());
    return scan;
  };
  localizer.expect({drive[0].truth, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()});
  for (std::size_t i = 0; i < 30; ++i) localizer.add(near(i), drive[i].odometry);
  ASSERT_EQ(localizer.localization().state, State::kLocalized);
  Pose slipped;  // the wheels turned on
  for (std::size_t i = 50; i < drive.size(); i += 20) {
    slipped.position.x() += 0.4;
    const Localization& now = localizer.add(near(i), composed(drive[i].odometry, slipped));
    EXPECT_EQ(now.state, State::kLocalized) << i;
    EXPECT_LT(distance_m(now.base.pose, drive[i].truth), 0.1) << i;
  }
}

TEST(ScanLocalizerRefusalTest, ATwinOfWhereTheOdometryLedIsNoRival) {
  World world = symmetric_room();
  const RobotModel& model = world.robots[0].model;
  const std::vector<Vector2> round{{6.0, 1.5}, {6.0, 3.5}, {2.0, 3.5}, {2.0, 1.5}};
  std::vector<Vector2> way;
  for (int i = 0; i < 4; ++i) way.insert(way.end(), round.begin(), round.end());
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map_of(drive_through(world, round, 1), model));
  const auto drive = drive_through(world, way, 2);
  localizer.expect({drive[0].truth, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()});
  follow(localizer, drive, model.lidar, 0, 30);
  ASSERT_EQ(localizer.localization().state, State::kLocalized);
  Pose wrong;  // by the odometry, while it sees nothing
  const std::size_t sees_again = drive.size() - 40;
  for (std::size_t i = 30; i < drive.size(); ++i) {
    ScanHits scan = hits_of(drive[i], model.lidar);
    if (i < sees_again) {
      scan.hits.clear();
      wrong.yaw_rad = 0.2 * static_cast<double>(i) / static_cast<double>(sees_again);
    }
    localizer.add(scan, composed(drive[i].odometry, wrong));
    if (i == sees_again) {
      EXPECT_NE(localizer.localization().state, State::kLocalized);
    }
  }
  EXPECT_EQ(localizer.localization().state, State::kLocalized);
  EXPECT_LT(distance_m(localizer.localization().base.pose, drive.back().truth), 0.1);
}

TEST(ScanLocalizerRefusalTest, ARoomBesideTheMapIsNotTakenForItsTwinInTheMap) {
  World world = symmetric_room();
  const RobotModel& model = world.robots[0].model;
  world.bounds = Eigen::AlignedBox2d(Vector2(0.0, 0.0), Vector2(17.0, 5.0));
  world.polygons = {box(0.0, 0.0, 0.2, 5.0)};
  for (const double x : {0.0, 7.8}) {  // two rooms, each with a door to the east
    world.polygons.push_back(box(x, 0.0, x + 8.0, 0.2));
    world.polygons.push_back(box(x, 4.8, x + 8.0, 5.0));
    world.polygons.push_back(box(x + 7.8, 0.0, x + 8.0, 1.0));
    world.polygons.push_back(box(x + 7.8, 2.0, x + 8.0, 5.0));
    world.circles.push_back({{x + 2.0, 3.6}, 0.4});
  }
  OccupancyGrid map = map_of(drive_through(world, {{6.0, 1.5}, {6.0, 3.5}, {4.0, 3.5}}, 1), model);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x)
      if (map.cell_centre(x, y).x() > 8.1) map.at(x, y) = OccupancyGrid::kUnknown;
  }
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map);
  std::vector<Vector2> way{{6.0, 1.5}, {10.5, 1.5}};
  for (int i = 0; i < 4; ++i) way.insert(way.end(), {{14.0, 1.5}, {14.0, 3.5}, {11.5, 2.5}});
  const auto drive = drive_through(world, way, 2);
  localizer.expect({drive[0].truth, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()});
  follow(localizer, drive, model.lidar, 0, 30);
  ASSERT_EQ(localizer.localization().state, State::kLocalized);
  const Account account = follow(localizer, drive, model.lidar, 30, drive.size());
  EXPECT_LT(Account::quantile(account.off_m, 1.0), 0.3);
  EXPECT_NE(localizer.localization().state, State::kLocalized);
}

TEST(ScanLocalizerRefusalTest, WhatNoSensorMeasuresIsRefusedAndChangesNothing) {
  World world = one_robot_world("config/worlds/corridor.yaml", {{0.0, 0.0}, 0.0});
  const RobotModel& model = world.robots[0].model;
  const auto drive = drive_through(world, corridor_path(), 2);
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map_of(drive, model));
  follow(localizer, drive, model.lidar, 0, 40);
  ASSERT_EQ(localizer.localization().state, State::kLocalized);
  const ScanHits sound = hits_of(drive[40], model.lidar);
  const auto refused = [&](ScanHits scan, Pose odometry) {
    EXPECT_THROW(localizer.add(scan, odometry), std::invalid_argument);
  };
  for (const double odd : {double{NAN}, double{INFINITY}, -1e300, 1e7}) {
    ScanHits scan = sound;
    scan.hits[3].x() = odd;
    refused(scan, drive[40].odometry);
    scan = sound;
    scan.sensor.y() = odd;
    refused(scan, drive[40].odometry);
    refused(sound, {{0.0, odd}, 0.0});
    if (!std::isfinite(odd)) refused(sound, {{0.0, 0.0}, odd});
    const PoseEstimate nowhere{{{odd, 0.0}, 0.0}, Eigen::Matrix3d::Identity()};
    EXPECT_THROW(localizer.expect(nowhere), std::invalid_argument);
  }
  for (const double odd : {double{NAN}, double{INFINITY}, drive[39].scan.end_time_s(), 0.0}) {
    ScanHits scan = sound;
    scan.time_s = odd;
    refused(scan, drive[40].odometry);
  }
  OccupancyGrid map = map_of(drive, model);
  map.resolution_m = INFINITY;  // the search through it would ask for 2^62 bytes
  EXPECT_THROW(localizer.set_map(map), std::invalid_argument);
  const Localization& now = localizer.add(sound, drive[40].odometry);
  EXPECT_EQ(now.state, State::kLocalized);
  EXPECT_LT(distance_m(now.base.pose, drive[40].truth), 0.1);
}

}  // namespace
}  // namespace mocha
