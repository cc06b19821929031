#pragma once

#include <ros/ros.h>

#include <exception>
#include <string>

#include "ros_bridge/runtime/clock_watch.h"
#include "ros_bridge/runtime/node_help.h"
#include "ros_bridge/runtime/parameters.h"

namespace mocha {

/// main() of a node: reads its parameters (config/<name>.yaml), checks them
/// against those of its neighbours, builds it and spins. What is wrong
/// at the start is said in one line, and the exit status is 1. `Node` is constructed from a node
/// handle and its ParameterTable.
template <typename Node>
int run_node(int argc, char** argv, const std::string& name) {
  if (prints_help(argc, argv, name)) return 0;
  ros::init(argc, argv, name);
  ros::NodeHandle node;  // outside: the console closes with the last handle
  ClockWatch clock(node);
  try {
    Node instance(node, checked_parameters(name));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s: %s", name.c_str(), error.what());
    return 1;
  }
  return 0;
}

}  // namespace mocha
