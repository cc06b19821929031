#pragma once

#include <string>
#include <vector>

#include "benchmarks/skid_odometry.h"
#include "benchmarks/trajectory_error.h"
#include "perception/localization/localisation_scene.h"
#include "perception/pose_graph/graph_mapper.h"

namespace mocha {

inline GraphMapperOptions shipped_mapper_options(const RobotModel& model) {
  return GraphMapperOptions::from(ParameterTable::from_schema("config/scan_localizer.yaml"), model);
}

/// Out of a room of the office, along the corridor and back, and through the room beside it home.
inline std::vector<Vector2> office_loop() {
  return {{2.0, 8.5}, {2.0, 6.0}, {10.0, 6.0}, {18.0, 6.0}, {10.0, 6.1},
          {6.0, 6.1}, {6.0, 7.6}, {5.0, 9.9},  {3.0, 10.1}, {2.0, 9.0}};
}

/// A drive with an odometry that skids, as the mapper gets it.
struct MappingDrive {
  std::vector<ScanHits> scans;
  std::vector<Pose> odometry;
  std::vector<Pose> truth;
};

inline MappingDrive mapping_drive(const std::string& world_path, const Pose& start,
                                  const std::vector<Vector2>& way, std::uint64_t seed) {
  const World world = one_robot_world(world_path, start, "waveshare_rover");
  const LidarModel& lidar = world.robots[0].model.lidar;
  SkidOdometry odometry(seed);
  MappingDrive drive;
  for (const DriveScan& sweep : drive_through(world, way, seed, 400.0)) {
    const Pose step = drive.truth.empty() ? Pose{} : relative(drive.truth.back(), sweep.truth);
    drive.scans.push_back(hits_of(beams_of(sweep, sweep.odometry_first, sweep.odometry, lidar),
                                  sweep.odometry, 0.02));
    drive.odometry.push_back(odometry.add(step));
    drive.truth.push_back(sweep.truth);
  }
  return drive;
}

/// How far keyframes are from where they were taken, after the map is moved to fit best. The drives
/// are all that the map is of; no two of their scans are of the same time.
inline std::vector<double> keyframe_errors_m(const PoseGraph& graph,
                                             const std::vector<ScanKeyframe>& keyframes,
                                             const std::vector<MappingDrive>& drives) {
  std::vector<Pose> truth;
  for (const ScanKeyframe& keyframe : keyframes) {
    for (const MappingDrive& drive : drives) {
      for (std::size_t i = 0; i < drive.scans.size(); ++i) {
        if (drive.scans[i].time_s == keyframe.scan.time_s) truth.push_back(drive.truth[i]);
      }
    }
  }
  return absolute_errors_m(graph.poses(), truth);
}

}  // namespace mocha
