#include "benchmarks/lidar_perception.h"

#include "perception/sensor/range_smoothing.h"
#include "stack/timing.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

Eigen::Isometry3d in_space(const Pose& pose, double height_m) {
  return Eigen::Translation3d(pose.position.x(), pose.position.y(), height_m) *
         Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ());
}

}  // namespace

PlanarScan planar_scan(const Scan& scan, const SimulatedRobot& robot) {
  const LidarModel& model = robot.setup.model.lidar;
  PlanarScan planar;
  planar.start_time_s = scan.start_time_s;
  planar.time_increment_s = robot.lidar.time_increment_s();
  planar.angle_min_rad = robot.lidar.angle_min_rad();
  planar.angle_increment_rad = robot.lidar.angle_increment_rad();
  planar.angle_max_rad =
      planar.angle_min_rad + planar.angle_increment_rad * (scan.ranges_m.size() - 1.0);
  planar.range_min_m = model.min_range_m;
  planar.range_max_m = model.max_range_m;
  planar.ranges_m = scan.ranges_m;
  return planar;
}

LidarPerception::LidarPerception(const RobotModel& robot)
    : robot_(robot),
      map_(OccupancyMapOptions::from(values_, robot.map_resolution_m)),
      filter_(MovingObjectFilterOptions::from(values_)) {}

void LidarPerception::take(const PlanarScan& scan, const Pose& first, const Pose& last) {
  const LidarModel& lidar = robot_.lidar;
  const auto sensor_at = [&](const Pose& base) {
    return in_space(composed(base, lidar.mount), lidar.height_m);
  };
  auto beams = to_beams(smoothed(scan, values_.number("smoothing_reach")),
                        {sensor_at(first), sensor_at(last)},
                        {values_.number("max_range"), values_.number("max_clearing_range")});
  map_.see_robot(last, StartGround(robot_), blind_walls(beams));
  filter_.sort(beams, map_);
  map_.insert_scan(beams);
  map_.clear_body(last, robot_.footprint);
  stamp_s_ = scan.end_time_s();
}

Predictions LidarPerception::predictions() const {
  Predictions predictions{stamp_s_, {}, filter_.spread()};
  for (const TrackedObstacle& thing : moving(stamp_s_)) {
    predictions.things.push_back({thing.id, thing.position, thing.velocity, thing.radius_m,
                                  PredictedDeviation::of(thing.covariance)});
  }
  return predictions;
}

std::optional<OccupancyGrid> LidarPerception::publish(double now_s) {
  const double since_s = now_s - published_s_;
  const bool changed = map_.version() != published_version_;
  const bool fresh = stamp_s_ > published_stamp_s_ && since_s >= kMapPeriod_s;
  if (!(changed || fresh) || since_s < 1.0 / values_.number("map_rate")) return std::nullopt;
  published_s_ = now_s;
  published_stamp_s_ = stamp_s_;
  published_version_ = map_.version();
  return map_.slice(values_.number("map_border"));
}

}  // namespace mocha
