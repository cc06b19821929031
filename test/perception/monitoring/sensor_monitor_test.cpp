#include "perception/monitoring/sensor_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <string>

#include "perception/lidar_drive.h"
#include "perception/sensor/range_smoothing.h"
#include "perception/shipped_options.h"

namespace mocha {
namespace {

constexpr double kBegins_s = 5.0;    // the robot is on its way then
constexpr double kSpacing_s = 0.09;  // perception takes ten scans a second

/// What a drive's monitor said, and the largest values that it compared.
struct Heard {
  std::map<SensorLie, double> first_s;  // when it was said first
  std::map<SensorLie, std::string> words;
  double lag_s = 0.0, turn_rad = 0.0, slip = 0.0, noise_m = 0.0, blind_rad = 0.0;
};

/// As perception does, in a map that is made on the way in the odometry's frame.
Heard listen(const std::vector<DriveScan>& drive, const RobotModel& model) {
  const auto values = ParameterTable::from_schema("config/perception.yaml");
  OccupancyMap map(shipped_map_options());
  MovingObjectFilter filter(shipped_sorter_options());
  SensorMonitor monitor(SensorMonitorOptions::from(values, model.lidar.noise_m));
  Heard heard;
  double newest_s = -kSpacing_s;
  for (const DriveScan& sweep : drive) {
    if (sweep.scan.start_time_s < newest_s + kSpacing_s) continue;
    newest_s = sweep.scan.start_time_s;
    DriveScan smooth = sweep;
    smooth.scan = smoothed(sweep.scan, shipped_smoothing_m());
    auto beams = beams_of(smooth, sweep.odometry_first, sweep.odometry, model.lidar);
    filter.sort(beams, map);
    monitor.add({sweep.scan, beams, sweep.odometry, sweep.odometry}, map);
    for (const auto& [lie, words] : monitor.lies()) {
      if (heard.first_s.emplace(lie, sweep.scan.end_time_s()).second) heard.words[lie] = words;
    }
    if (const auto& difference = monitor.difference()) {
      heard.lag_s = std::max(heard.lag_s, difference->lag_s);
      heard.turn_rad = std::max(heard.turn_rad, std::abs(difference->turn_rad));
      heard.slip = std::max(heard.slip, std::abs(difference->slip));
    }
    heard.noise_m = std::max(heard.noise_m, monitor.noise_m());
    heard.blind_rad = std::max(heard.blind_rad, monitor.blind_rad());
    if (!monitor.stop().empty()) continue;
    map.insert_scan(beams);
  }
  return heard;
}

/// Among people that walk, and that nothing runs into.
struct Drive {
  const char* world;
  const char* model;
  Pose start;
  std::vector<Vector2> waypoints;
};

std::ostream& operator<<(std::ostream& out, const Drive& drive) {
  return out << drive.model << " in " << drive.world;
}

const Drive kCrossing{"config/worlds/crossing.yaml",
                      "rover",
                      {{1.5, 0.0}, 0.0},
                      {{4.0, 0.0}, {4.0, -2.0}, {2.0, -2.0}, {1.0, 0.5}, {4.0, 0.0}, {4.0, -2.0}}};
const Drive kSmallRover{kCrossing.world, "waveshare_rover", kCrossing.start, kCrossing.waypoints};
const Drive kJackal{kCrossing.world, "jackal", kCrossing.start, kCrossing.waypoints};
const Drive kPeople{
    "test/worlds/people.yaml", "rover", {{-4.5, 0.0}, 0.0}, {{0.3, 0.0}, {0.0, 2.0}, {-4.5, 0.5}}};
const Drive kRooms{"config/worlds/rooms.yaml",
                   "rover",
                   {{1.0, 1.0}, 0.0},
                   {{2.5, 4.0}, {2.55, 6.0}, {8.0, 6.2}, {8.5, 8.0}, {8.0, 10.0}}};
const Drive kCorridor{"config/worlds/corridor.yaml",
                      "rover",
                      {{0.0, 0.0}, 0.0},
                      {{3.4, 1.5}, {5.0, 0.0}, {7.2, 1.1}, {9.0, 0.1}, {10.7, 1.3}, {12.8, 0.0}}};

Heard listen(const Drive& drive, const SensorFault& fault, double longest_s) {
  const World world = one_robot_world(drive.world, drive.start, drive.model);
  return listen(drive_through(world, drive.waypoints, 1, longest_s, {fault, kBegins_s}),
                world.robots[0].model);
}

class HonestSensors : public testing::TestWithParam<Drive> {};

TEST_P(HonestSensors, AreNeverCalledLiars) {
  const Heard heard = listen(GetParam(), {}, 20.0);
  for (const auto& [lie, words] : heard.words) ADD_FAILURE() << words;
  // The limits are far from what is measured.
  EXPECT_EQ(heard.lag_s, 0.0);
  EXPECT_LT(heard.slip, 0.07);
  EXPECT_LT(heard.noise_m, 0.012);
  EXPECT_LT(heard.blind_rad, 0.15);
}

INSTANTIATE_TEST_SUITE_P(AmongPeople, HonestSensors,
                         testing::Values(kCrossing, kSmallRover, kJackal, kPeople, kRooms,
                                         kCorridor));

struct Lie {
  SensorLie kind;
  SensorFault fault;
  double within_s;
  const char* words;
};

std::ostream& operator<<(std::ostream& out, const Lie& lie) { return out << lie.words; }

SensorFault lidar(const LidarFault& fault) { return {fault, {}}; }
SensorFault odometry(const OdometryFault& fault) { return {{}, fault}; }

class LyingSensors : public testing::TestWithParam<Lie> {};

TEST_P(LyingSensors, AreNoticed) {
  const Lie& lie = GetParam();
  for (const Drive& drive : {kCrossing, kJackal}) {
    SCOPED_TRACE(testing::PrintToString(drive));
    const Heard heard = listen(drive, lie.fault, kBegins_s + lie.within_s);
    ASSERT_EQ(heard.first_s.count(lie.kind), 1u);
    const double noticed_s = heard.first_s.at(lie.kind) - kBegins_s;
    EXPECT_GT(noticed_s, 0.0);
    EXPECT_LT(noticed_s, lie.within_s);
    EXPECT_NE(heard.words.at(lie.kind).find(lie.words), std::string::npos)
        << heard.words.at(lie.kind);
    for (const auto& [other, since_s] : heard.first_s)
      EXPECT_GE(since_s, heard.first_s.at(lie.kind)) << heard.words.at(other) << " is said before";
  }
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, LyingSensors,
    testing::Values(
        Lie{SensorLie::kScanFrozen, lidar({true, 0.0, 0.0, 1.0, 0.0}), 0.5, "scan is frozen"},
        Lie{SensorLie::kScanLate, lidar({false, 0.3, 0.0, 1.0, 0.0}), 6.0, "scans are late"},
        Lie{SensorLie::kScanTurned, lidar({false, 0.0, 0.05236, 1.0, 0.0}), 6.0,
            "degrees to the left"},
        Lie{SensorLie::kScanTurned, lidar({false, 0.0, -0.05236, 1.0, 0.0}), 6.0,
            "degrees to the right"},
        Lie{SensorLie::kScanNoisy, lidar({false, 0.0, 0.0, 3.0, 0.0}), 1.5, "lidar is noisy"},
        Lie{SensorLie::kScanBlind, lidar({false, 0.0, 0.0, 1.0, 1.0472}), 0.5, "lidar is blind"},
        Lie{SensorLie::kOdometryFrozen, odometry({true, 0.0}), 1.0, "odometry is frozen"},
        Lie{SensorLie::kOdometrySlips, odometry({false, 0.2}), 6.0, "% more travel"},
        Lie{SensorLie::kOdometrySlips, odometry({false, -0.2}), 6.0, "% less travel"}));

}  // namespace
}  // namespace mocha
