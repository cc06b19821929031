#include "perception/monitoring/sensor_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "perception/lidar_drive.h"
#include "perception/sensor/range_smoothing.h"
#include "perception/shipped_options.h"

namespace mocha {
namespace {

constexpr double kBegins_s = 6.0;  // the robot is on its way then

/// What a drive's monitor said, and the largest values that it compared.
struct Heard {
  std::map<SensorLie, double> first_s;  // when it was said first
  std::string words;                    // the first
  double lag_s = 0.0, turn_rad = 0.0, slip = 0.0, noise_m = 0.0, blind_rad = 0.0;
};

ParameterTable shipped() { return ParameterTable::from_schema("config/perception.yaml"); }

/// As perception does, in a map that is made on the way in the odometry's frame.
Heard listen(const std::vector<DriveScan>& drive, const RobotModel& model) {
  OccupancyMap map(shipped_map_options());
  MovingObjectFilter filter(shipped_sorter_options());
  SensorMonitor monitor(SensorMonitorOptions::from(shipped(), model.lidar.noise_m));
  Heard heard;
  for (const DriveScan& sweep : drive) {
    DriveScan smooth = sweep;
    smooth.scan = smoothed(sweep.scan, shipped_smoothing_m());
    auto beams = beams_of(smooth, sweep.odometry_first, sweep.odometry, model.lidar);
    const ScanHits hits = hits_of(beams, sweep.odometry, 0.0);
    monitor.add({sweep.scan, beams, hits, sweep.odometry}, map);
    for (const auto& [lie, words] : monitor.lies()) {
      if (heard.first_s.empty()) heard.words = words;
      heard.first_s.emplace(lie, sweep.scan.end_time_s());
    }
    if (const auto& difference = monitor.difference()) {
      heard.lag_s = std::max(heard.lag_s, difference->lag_s);
      heard.turn_rad = std::max(heard.turn_rad, std::abs(difference->turn_rad));
      heard.slip = std::max(heard.slip, std::abs(difference->slip));
    }
    heard.noise_m = std::max(heard.noise_m, monitor.noise_m());
    heard.blind_rad = std::max(heard.blind_rad, monitor.blind_rad());
    if (!monitor.stop().empty()) continue;
    filter.sort(beams, map);
    map.insert_scan(beams);
  }
  return heard;
}

struct Drive {
  const char* world;
  const char* model;
  Pose start;
  std::vector<Vector2> waypoints;
};

const Drive kDrives[] = {
    {"test/worlds/people.yaml", "rover", {{-4.5, 0.0}, 0.0}, {{0.3, 0.0}, {0.0, 2.0}, {-4.5, 0.5}}},
    {"config/worlds/crossing.yaml", "rover", {{1.5, 0.0}, 0.0}, {{4.0, 0.0}, {4.0, -2.0}, {2.0, -2.0}, {1.0, 0.5}, {4.0, 0.0}, {4.0, -2.0}}},
    {"config/worlds/rooms.yaml",
     "rover",
     {{1.0, 1.0}, 0.0},
     {{2.5, 4.0}, {2.55, 6.0}, {8.0, 6.2}, {8.5, 8.0}, {8.0, 10.0}, {8.5, 6.0}, {2.5, 6.0}}},
    {"config/worlds/corridor.yaml",
     "rover",
     {{0.0, 0.0}, 0.0},
     {{3.4, 1.5}, {5.0, 0.0}, {7.2, 1.1}, {9.0, 0.1}, {10.7, 1.3}, {12.8, 0.0}, {14.6, 0.9}}},
    {"config/worlds/crossing.yaml", "waveshare_rover", {{1.5, 0.0}, 0.0}, {{4.0, 0.0}, {4.0, -2.0}, {2.0, -2.0}, {1.0, 0.5}, {4.0, 0.0}}},
    {"config/worlds/crossing.yaml", "jackal", {{1.5, 0.0}, 0.0}, {{4.0, 0.0}, {4.0, -2.0}, {2.0, -2.0}, {1.0, 0.5}, {4.0, 0.0}, {4.0, -2.0}, {2.0, -2.0}, {1.0, 0.5}}},
};

Heard listen(const Drive& where, const DriveFault& lie, std::uint64_t seed) {
  const World world = one_robot_world(where.world, where.start, where.model);
  return listen(drive_through(world, where.waypoints, seed, 40.0, lie), world.robots[0].model);
}

SensorFault fault(const std::string& name) {
  auto values = ParameterTable::from_schema("config/fleet_simulator.yaml");
  values.change({{"sensor_fault", name}});
  return SensorFault::from(values);
}

TEST(SensorMonitor, MEASURE) {
  for (const Drive& drive : kDrives) {
    for (const char* name :
         {"none", "scan_frozen", "scan_delayed", "scan_rotated", "scan_noisy", "scan_blind_sector",
          "odometry_frozen", "odometry_slipping"}) {
      const Heard h = listen(drive, {fault(name), kBegins_s}, 3);
      printf("%-28s %-8.8s %-18s lag %.2f turn %.4f slip %.3f noise %.4f blind %.3f |", drive.world,
             drive.model, name, h.lag_s, h.turn_rad, h.slip, h.noise_m, h.blind_rad);
      for (auto& [lie, t] : h.first_s) printf(" %d at %.1f", int(lie), t - kBegins_s);
      printf(" %s\n", h.words.c_str());
    }
  }
}

}  // namespace
}  // namespace mocha
