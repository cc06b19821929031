#include "ros_bridge/inputs/sensor_watch.h"

#include <ros/console.h>

#include <cmath>

#include "ros_bridge/messages/sensor_conversions.h"

namespace mocha {

void SensorWatch::look(const Measurement& measurement, const std::vector<Beam>& beams,
                       const std::optional<Pose>& base, const OccupancyMap& map,
                       const tf2::BufferCore& transforms) {
  const auto* scan = std::get_if<PlanarScan>(&measurement.data);
  if (scan == nullptr || !base) return;
  std::optional<Pose> odometry;
  if (transforms.canTransform(robot_.odom_frame, robot_.base_frame, measurement.last)) {
    odometry = planar_pose(
        transforms.lookupTransform(robot_.odom_frame, robot_.base_frame, measurement.last)
            .transform);
  }
  monitor_.add({*scan, beams, *base, odometry}, map);
  if (monitor_.lies().size() > lies_) {
    for (const auto& [lie, words] : monitor_.lies())
      ROS_WARN("%s: %s%s", robot_.name.c_str(), words.c_str(),
               stops_the_robot(lie) ? "; the robot stops" : "");
  }
  lies_ = monitor_.lies().size();
}

void SensorWatch::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "lidar, odometry and map agree");
  std::string words;
  for (const auto& [lie, what] : monitor_.lies()) words += (words.empty() ? "" : "; ") + what;
  if (!monitor_.stop().empty()) {
    status.summary(DiagnosticStatus::ERROR, words + "; the robot stops");
  } else if (!words.empty()) {
    status.summary(DiagnosticStatus::WARN, words);
  }
  status.addf("noise of the lidar [mm]", "%.1f", 1e3 * monitor_.noise_m());
  status.addf("beams without return where the map has walls [degrees]", "%.1f",
              monitor_.blind_rad() * 180.0 / M_PI);
  const auto& found = monitor_.difference();
  status.add("motion compared",
             found ? "yes" : "no: not enough of it yet, or of what stands in sight");
  if (!found) return;
  status.addf("scans older than they say [s]", "%.2f", found->lag_s);
  status.addf("lidar turned to the left [degrees]", "%.2f", found->turn_rad * 180.0 / M_PI);
  status.addf("travel that the odometry reports too much [%]", "%.1f", 100.0 * found->slip);
}

}  // namespace mocha
