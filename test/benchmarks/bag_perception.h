#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <rosbag/bag.h>
#include <tf2/buffer_core.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "perception/tracking/moving_object_filter.h"
#include "ros_bridge/inputs/scan_queue.h"
#include "world/start_ground.h"

namespace mocha {

/// A person as somebody has marked it in a scan: at the time of the beam that leads there.
struct PersonLabel {
  std::uint32_t person;
  double time_s;
  Vector2 place;  ///< map frame [m]
  double bearing_rad;
};

/// What perception makes of one scan.
struct BagScan {
  double begin_s;
  double end_s;
  Pose sensor;  ///< at its end
  std::vector<TrackedObstacle> things;
  std::vector<Beam> moving_hits;
  std::vector<PersonLabel> labels;
};

/// What the node perception does with the laser scans of a bag, in one process: with the
/// parameters of config/, and where the lidars were by the bag's own transforms.
class BagPerception {
 public:
  /// Labels are geometry_msgs/PoseStamped in the frame and with the stamp of a scan, and the number
  /// of the person in header.seq.
  BagPerception(const rosbag::Bag& bag, const std::string& map_frame);

  /// A lidar that stands there; before the scans are taken.
  void mount(const std::string& frame, const Pose& pose);

  /// All scans, in their order in the bag.
  std::vector<BagScan> run();

  const OccupancyMap& map() const { return map_; }

 private:
  void add_transforms();
  std::optional<Pose> base_at(ros::Time time) const;
  BagScan take(const Measurement& measurement);
  std::vector<PersonLabel> labels_of(const Measurement& measurement) const;

  const rosbag::Bag& bag_;
  const std::string map_frame_;
  const ParameterTable values_;
  const RobotModel model_;
  const StartGround start_ground_;
  OccupancyMap map_;
  MovingObjectFilter filter_;
  tf2::BufferCore transforms_;
  std::map<ros::Time, std::vector<geometry_msgs::PoseStamped>> labels_;
  double stamp_s_ = 0.0;
};

}  // namespace mocha
