#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "perception/sensor/planar_scan.h"
#include "perception/sensor/scan_hits.h"
#include "simulation/world_simulator.h"
#include "trajectory/frame_change.h"

namespace mocha {

/// One sweep of a simulated drive, and where the robot was when it ended.
struct DriveScan {
  PlanarScan scan;
  Pose odometry_first;  ///< believed, when the sweep began
  Pose odometry;        ///< believed, when it ended
  Pose truth;           ///< map frame, when it ended
  Pose truth_first;
};

inline World one_robot_world(const std::string& path, const Pose& start,
                             const std::string& model = "rover") {
  World world = load_world(path, "config");
  world.robots.resize(1);
  world.robots[0].model = load_robot_model("config", model);
  world.robots[0].start = start;
  return world;
}

/// Towards a point: turns until it is ahead, then drives.
inline Twist towards(const Pose& pose, const Vector2& goal, const MotionLimits& limits) {
  const Vector2 way = goal - pose.position;
  const double off = wrap_angle(std::atan2(way.y(), way.x()) - pose.yaw_rad);
  const double yaw_rate = std::clamp(2.0 * off, -limits.max_yaw_rate, limits.max_yaw_rate);
  return {limits.max_speed * std::max(0.0, 1.0 - std::abs(off)) * std::min(1.0, way.norm()),
          yaw_rate};
}

/// Sensors that begin to lie during a drive.
struct DriveFault {
  SensorFault fault;
  double from_s = 0.0;
};

/// The sweeps of the world's first robot on its way through `waypoints`; walls do not stop it.
inline std::vector<DriveScan> drive_through(const World& world,
                                            const std::vector<Vector2>& waypoints,
                                            std::uint64_t seed, double longest_s = 120.0,
                                            const DriveFault& lie = {}) {
  constexpr double kStep_s = 0.02;
  constexpr double kNear_m = 0.2;
  WorldSimulator simulator(world, 0.0, seed);
  const SimulatedRobot& robot = simulator.robots()[0];
  const LidarModel& lidar = robot.setup.model.lidar;
  PoseHistory believed(1.0);
  believed.add(0.0, robot.odometry.pose());
  std::vector<DriveScan> drive;
  std::size_t next = 0;
  for (int step = 1; step * kStep_s < longest_s && next < waypoints.size(); ++step) {
    simulator.command(0, towards(robot.vehicle.pose(), waypoints[next], robot.setup.model.limits));
    const bool begins = simulator.time_s() < lie.from_s && step * kStep_s >= lie.from_s;
    if (begins) simulator.set_fault("", lie.fault);
    const auto result = simulator.step_to(step * kStep_s);
    believed.add(simulator.time_s(), robot.odometry.pose());
    for (const auto& sweep : result.scans) {
      if (sweep.robot != 0) continue;
      PlanarScan scan;
      scan.start_time_s = sweep.scan.start_time_s;
      scan.time_increment_s = robot.lidar.time_increment_s();
      scan.angle_min_rad = robot.lidar.angle_min_rad();
      scan.angle_increment_rad = robot.lidar.angle_increment_rad();
      scan.ranges_m = sweep.scan.ranges_m;
      scan.angle_max_rad =
          scan.angle_min_rad + scan.angle_increment_rad * (scan.ranges_m.size() - 1.0);
      scan.range_min_m = lidar.min_range_m;
      scan.range_max_m = lidar.max_range_m;
      drive.push_back({scan, believed.at(scan.start_time_s), believed.at(scan.end_time_s()),
                       robot.past.at(scan.end_time_s()), robot.past.at(scan.start_time_s)});
    }
    if ((robot.vehicle.pose().position - waypoints[next]).norm() < kNear_m) ++next;
  }
  return drive;
}

inline Eigen::Isometry3d in_space(const Pose& pose) {
  return Eigen::Translation3d(pose.position.x(), pose.position.y(), 0.2) *
         Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ());
}

/// The beams of a sweep in the frame in which the base stood at `first` and `last`.
inline std::vector<Beam> beams_of(const DriveScan& sweep, const Pose& first, const Pose& last,
                                  const LidarModel& lidar) {
  return to_beams(sweep.scan,
                  {in_space(composed(first, lidar.mount)), in_space(composed(last, lidar.mount))},
                  {30.0, 10.0});
}

}  // namespace mocha
