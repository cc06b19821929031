#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "perception/sensor/planar_scan.h"
#include "trajectory/motion.h"

namespace mocha {

/// A rectangular room with round things in it, measured without error.
struct Room {
  struct Circle {
    Vector2 centre;
    double radius_m;
  };

  Vector2 low{-4.03, -3.02};
  Vector2 high{5.01, 2.48};
  std::vector<Circle> circles;

  double range(const Vector2& from, double angle) const {
    const Vector2 ray(std::cos(angle), std::sin(angle));
    double nearest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 2; ++axis) {
      const double wall = ray[axis] > 0.0 ? high[axis] : low[axis];
      if (ray[axis] != 0.0) nearest = std::min(nearest, (wall - from[axis]) / ray[axis]);
    }
    for (const Circle& circle : circles) {
      const Vector2 to = circle.centre - from;
      const double along = to.dot(ray);
      const double off = to.squaredNorm() - along * along;
      const double half = circle.radius_m * circle.radius_m - off;
      if (along > 0.0 && half > 0.0) nearest = std::min(nearest, along - std::sqrt(half));
    }
    return nearest;
  }
};

inline Eigen::Isometry3d sensor_pose(const Pose& pose, double height_m = 0.2) {
  return Eigen::Translation3d(pose.position.x(), pose.position.y(), height_m) *
         Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ());
}

/// A sweep of `beams` all round, with the sensor at pose_at(share of the sweep).
inline PlanarScan sweep(const Room& room, const std::function<Pose(double)>& pose_at,
                        double range_max_m = 20.0, int beams = 720, double sweep_s = 0.0) {
  PlanarScan scan;
  scan.angle_min_rad = -M_PI;
  scan.angle_increment_rad = 2.0 * M_PI / beams;
  scan.angle_max_rad = M_PI - scan.angle_increment_rad;
  scan.time_increment_s = sweep_s / (beams - 1);
  scan.range_max_m = range_max_m;
  for (int i = 0; i < beams; ++i) {
    const Pose pose = pose_at(i / (beams - 1.0));
    const double range =
        room.range(pose.position, pose.yaw_rad + scan.angle_min_rad + i * scan.angle_increment_rad);
    scan.ranges_m.push_back(
        static_cast<float>(range < range_max_m ? range : std::numeric_limits<double>::infinity()));
  }
  return scan;
}

inline std::vector<Beam> beams_at(const Room& room, const Pose& pose, double range_max_m = 20.0,
                                  int beams = 720) {
  const SweepPoses still{sensor_pose(pose), sensor_pose(pose)};
  return to_beams(sweep(
                      room, [&](double) { return pose; }, range_max_m, beams),
                  still, {30.0, 10.0});
}

}  // namespace mocha
