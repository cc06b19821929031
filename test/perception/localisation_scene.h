#pragma once

#include <string>
#include <vector>

#include "perception/lidar_drive.h"
#include "perception/occupancy_map.h"
#include "perception/wall_field.h"

namespace mocha {

/// Once to and fro through the corridor of the demo, around its cylinders.
inline std::vector<Vector2> corridor_way() {
  return {{3.4, 1.5},  {5.0, 0.0},   {7.2, 1.1},   {9.0, 0.1},   {10.7, 1.3},
          {12.8, 0.0}, {14.6, 0.9},  {17.0, 0.6},  {18.5, 1.2},  {18.5, -1.2},
          {17.0, 0.0}, {14.6, -1.3}, {12.6, -0.2}, {11.0, -1.1}, {9.0, 0.0},
          {7.2, -1.2}, {5.0, -0.1},  {3.0, -1.0},  {0.0, 0.0}};
}

/// What perception would have made of a drive whose poses are known.
inline OccupancyGrid map_of(const std::vector<DriveScan>& drive, const RobotModel& model) {
  OccupancyMapOptions options;
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

inline double distance_m(const Pose& a, const Pose& b) { return (a.position - b.position).norm(); }
inline double turn_rad(const Pose& a, const Pose& b) {
  return std::abs(wrap_angle(a.yaw_rad - b.yaw_rad));
}

}  // namespace mocha
