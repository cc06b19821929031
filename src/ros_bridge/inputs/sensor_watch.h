#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>
#include <vector>

#include "perception/monitoring/sensor_monitor.h"
#include "ros_bridge/inputs/scan_queue.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// Watches a robot's lidar and odometry for lies, and says in diagnostics which of them lies, and
/// by how much.
class SensorWatch {
 public:
  SensorWatch(const RobotIdentity& robot, const SensorMonitorOptions& options)
      : robot_(robot), monitor_(options) {}

  /// Takes the next scan, before it enters the map, when hits on what moves have been told from the
  /// others. `beams` and `base`, base_link at the time of the last beam, are in the map frame; the
  /// odometry comes from tf.
  void look(const Measurement& measurement, const std::vector<Beam>& beams,
            const std::optional<Pose>& base, const OccupancyMap& map,
            const tf2::BufferCore& transforms);

  /// Why the robot must not drive; empty: it may.
  std::string stop() const { return monitor_.stop(); }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  void clear() { monitor_.clear(); }

 private:
  RobotIdentity robot_;
  SensorMonitor monitor_;
  std::size_t lies_ = 0;  // of which the log knows
};

}  // namespace mocha
