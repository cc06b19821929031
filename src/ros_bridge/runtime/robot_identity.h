#pragma once

#include <ros/this_node.h>

#include <string>

namespace mocha {

/// Name and frames of the robot that a node serves: both follow from the node's namespace
/// (`/ugv1`).
struct RobotIdentity {
  std::string name;        ///< "ugv1"; "robot" outside any namespace
  std::string map_frame;   ///< "map", shared by the fleet
  std::string odom_frame;  ///< "ugv1/odom"
  std::string base_frame;  ///< "ugv1/base_link"
};

inline RobotIdentity robot_identity() {
  std::string name = ros::this_node::getNamespace();
  name.erase(0, name.find_first_not_of('/'));
  if (name.empty()) return {"robot", "map", "odom", "base_link"};
  return {name, "map", name + "/odom", name + "/base_link"};
}

}  // namespace mocha
