#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "perception/mapping/occupancy_map.h"
#include "perception/sensor/planar_scan.h"
#include "perception/tracking/moving_object_filter.h"
#include "simulation/world_simulator.h"
#include "world/robot_model.h"

namespace mocha {

/// A sweep of the lidar of a simulated robot, as the nodes hear it.
PlanarScan planar_scan(const Scan& scan, const SimulatedRobot& robot);

/// What the node perception makes of the scans of a robot without team-mates, with the parameters
/// of config/: maps, as often as it publishes them, and what moves.
class LidarPerception {
 public:
  explicit LidarPerception(const RobotModel& robot);

  /// The next sweep, and where the base was at its first and its last beam.
  void take(const PlanarScan& scan, const Pose& first, const Pose& last);

  /// A map where one is published now: it has changed, or the last one is old.
  std::optional<OccupancyGrid> publish(double now_s);

  std::vector<TrackedObstacle> moving(double time_s) const { return filter_.moving(time_s); }
  /// The same as the node publishes it, at the time of the newest scan.
  Predictions predictions() const;
  /// The most scans a second that enter the map.
  double integration_rate_hz() const { return values_.number("integration_rate"); }

 private:
  const RobotModel robot_;
  const ParameterTable values_ = ParameterTable::from_schema("config/perception.yaml");
  OccupancyMap map_;
  MovingObjectFilter filter_;
  double stamp_s_ = 0.0;            // of the newest scan in the map
  double published_stamp_s_ = 0.0;  // of the newest scan in the newest map published
  double published_s_ = 0.0;
  std::uint64_t published_version_ = 0;
};

}  // namespace mocha
