#pragma once

#include <string>
#include <vector>

#include "perception/lidar_drive.h"
#include "perception/localization/likelihood_field.h"
#include "perception/shipped_options.h"

namespace mocha {

/// Once to and fro through the corridor of the demo, around its cylinders.
inline std::vector<Vector2> corridor_path() {
  return {{3.4, 1.5},  {5.0, 0.0},   {7.2, 1.1},   {9.0, 0.1},   {10.7, 1.3},
          {12.8, 0.0}, {14.6, 0.9},  {17.0, 0.6},  {18.5, 1.2},  {18.5, -1.2},
          {17.0, 0.0}, {14.6, -1.3}, {12.6, -0.2}, {11.0, -1.1}, {9.0, 0.0},
          {7.2, -1.2}, {5.0, -0.1},  {3.0, -1.0},  {0.0, 0.0}};
}

/// What perception would have made of a drive whose poses are known.
inline OccupancyGrid map_of(const std::vector<DriveScan>& drive, const RobotModel& model) {
  OccupancyMapOptions options = shipped_map_options();
  options.resolution_m = model.map_resolution_m;
  OccupancyMap map(options);
  for (const DriveScan& sweep : drive)
    map.insert_scan(beams_of(sweep, sweep.truth_first, sweep.truth, model.lidar));
  return map.slice(0.5);
}

/// A sweep as the localiser gets it: made straight by the odometry.
inline ScanHits hits_of(const DriveScan& sweep, const LidarModel& lidar) {
  return hits_of(beams_of(sweep, sweep.odometry_first, sweep.odometry, lidar), sweep.odometry,
                 0.05);
}

inline Polygon box(double x0, double y0, double x1, double y1) {
  return Polygon{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

inline double distance_m(const Pose& a, const Pose& b) { return (a.position - b.position).norm(); }
inline double turn_rad(const Pose& a, const Pose& b) {
  return std::abs(wrap_angle(a.yaw_rad - b.yaw_rad));
}

/// A drive from which a piece is missing: as if the robot had been carried.
struct Kidnapping {
  std::vector<DriveScan> drive;
  std::size_t when;  // the first sweep after it
};

/// Carried from sweep `from` on, to the first place of the drive at least `carried_m` away.
inline Kidnapping kidnap(const std::vector<DriveScan>& drive, std::size_t from, double carried_m) {
  std::size_t to = from;
  while (distance_m(drive.at(to).truth, drive[from].truth) < carried_m) ++to;
  Kidnapping result{{drive.begin(), drive.begin() + static_cast<std::ptrdiff_t>(from)}, from};
  const Pose shift =
      composed(drive[from - 1].odometry, relative(drive[to - 1].odometry, {{0.0, 0.0}, 0.0}));
  const double passed_s = drive[to].scan.start_time_s - drive[from].scan.start_time_s;
  for (std::size_t i = to; i < drive.size(); ++i) {
    DriveScan sweep = drive[i];
    sweep.scan.start_time_s -= passed_s;
    sweep.odometry = composed(shift, sweep.odometry);
    sweep.odometry_first = composed(shift, sweep.odometry_first);
    result.drive.push_back(sweep);
  }
  return result;
}

}  // namespace mocha
