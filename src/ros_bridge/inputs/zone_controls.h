#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <mocha_ugv/SetZones.h>
#include <mocha_ugv/Zones.h>
#include <ros/ros.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/parameter_table.h"
#include "perception/mapping/keep_out.h"
#include "ros_bridge/inputs/committed_trajectory_source.h"
#include "ros_bridge/outputs/map_outputs.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "world/zones.h"

namespace mocha {

/// The zones of one robot as people meet them: the service `set_zones`, the file that they come
/// from, which is read again when it is written, and what is in force, latched, as `zones` and, for
/// rviz, as `zone_markers`. They outlive the node, as its parameter `zones_in_force`.
class ZoneControls {
 public:
  /// `values` are those of config/perception.yaml. Throws WorldError for zones that are none.
  ZoneControls(ros::NodeHandle& node, const RobotIdentity& robot, const RobotModel& model,
               const ParameterTable& values);

  /// Marks what is not to be entered in the maps; the robot is at `base`, if that is known.
  void step(ros::Time now, const std::optional<Pose>& base, const OccupancyMap& map,
            MapOutputs& maps);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  bool on_set(mocha_ugv::SetZones::Request& request, mocha_ugv::SetZones::Response& response);
  void set(Zones zones);
  void follow_file();
  std::vector<Pose> course_from(const Pose& base, ros::Time now) const;
  void publish();

  const RobotIdentity robot_;
  const Braking braking_;
  std::string file_;  // the zones are those of; empty: of none
  std::filesystem::file_time_type written_;
  std::string trouble_;  // with the file
  Zones zones_;
  KeepOut keep_out_;
  int shown_ = -1;  // of the versions of what is kept out of
  bool are_new_ = true;
  const Zone* inside_ = nullptr;
  ros::Time since_;
  ros::Time looked_;
  CommittedTrajectorySource committed_;
  ros::Publisher states_;
  ros::Publisher drawings_;
  ros::ServiceServer calls_;
};

}  // namespace mocha
