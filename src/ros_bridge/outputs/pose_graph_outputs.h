#pragma once

#include <mocha_ugv/GetKeyframes.h>
#include <mocha_ugv/LoadMap.h>
#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "perception/pose_graph/mapping_session.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// The map that is being made, for the others: where the keyframes are as `pose_graph`, their scans
/// by the service `get_keyframes`, for rviz `pose_graph_markers`, and as a file that is written
/// every half a minute, and in the end. The service `merge_pose_graph` takes such a file of another
/// drive into it.
class PoseGraphOutputs {
 public:
  /// The session must outlive this. No file where `path` is empty.
  PoseGraphOutputs(ros::NodeHandle& node, const RobotIdentity& robot, MappingSession& session,
                   std::string path);
  ~PoseGraphOutputs();

  /// Publishes what has changed since the last time.
  void step(ros::Time now);

 private:
  bool on_get(mocha_ugv::GetKeyframes::Request& request,
              mocha_ugv::GetKeyframes::Response& response);
  bool on_merge(mocha_ugv::LoadMap::Request& request, mocha_ugv::LoadMap::Response& response);
  void publish(ros::Time now);
  void save();

  const std::string frame_;
  const std::string path_;
  MappingSession& session_;
  const GraphMapper* mapper_ = nullptr;  // of which was published last
  int keyframes_ = 0;                    // published
  int corrections_ = 0;
  bool is_saved_ = true;
  ros::Time saved_;
  ros::Publisher graphs_;
  ros::Publisher drawings_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace mocha
