#pragma once

#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <deque>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "perception/sensor/planar_scan.h"
#include "ros_bridge/inputs/refusals.h"

namespace mocha {

/// A scan or a cloud (points in the sensor's frame), and where the sensor was.
struct Measurement {
  std::string frame;
  ros::Time first;  ///< time of the first beam
  ros::Time last;   ///< time of the last beam
  std::variant<PlanarScan, std::vector<Eigen::Vector3f>> data;
  SweepPoses poses;  ///< in the map frame
};

/// Scans and clouds that wait for their transforms. What is malformed is refused at once.
class ScanQueue {
 public:
  /// Of each sensor (by frame) at most `rate` measurements a second are taken, the others are left
  /// out. What waits longer than `patience_s` is dropped.
  ScanQueue(std::string map_frame, double rate, double patience_s);

  void add(const sensor_msgs::LaserScan& scan, ros::Time now, Refusals& refusals);
  void add(const sensor_msgs::PointCloud2& cloud, ros::Time now, Refusals& refusals);

  /// Removes and returns what has transforms for its first and last beam.
  std::vector<Measurement> take_ready(const tf2::BufferCore& transforms, ros::Time now,
                                      Refusals& refusals);

  std::size_t waiting() const { return waiting_.size(); }
  /// When the last well-formed message came in; zero before.
  ros::Time received() const { return received_; }

  void clear();

 private:
  /// False if this one is not to be used; the reason, if it is a fault, is counted.
  bool accept(const std::string& frame, ros::Time first, ros::Time now, Refusals& refusals);
  bool locate(Measurement& measurement, const tf2::BufferCore& transforms, std::string& why) const;

  std::string map_frame_;
  ros::Duration spacing_;
  double patience_s_;
  std::deque<Measurement> waiting_;
  std::map<std::string, ros::Time> accepted_;  // the newest of each frame
  ros::Time received_;
};

}  // namespace mocha
