#pragma once

#include <ros/ros.h>

#include <memory>
#include <string>

#include "ros_bridge/runtime/clock_watch.h"
#include "ros_bridge/runtime/node_help.h"
#include "ros_bridge/runtime/node_start.h"
#include "ros_bridge/runtime/parameters.h"

namespace mocha {

/// main() of a node: reads its parameters (config/<name>.yaml), checks them
/// against those of its neighbours, builds it and spins. What is wrong at the start: see NodeStart.
/// `Node` is constructed from a node handle and its ParameterTable.
template <typename Node>
int run_node(int argc, char** argv, const std::string& name) {
  if (prints_help(argc, argv, name)) return 0;
  const NodeStart start(argc, argv, name);
  ros::NodeHandle node;  // outside: the console closes with the last handle
  ClockWatch clock(node);
  std::unique_ptr<Node> instance;
  return start.run([&] { instance = std::make_unique<Node>(node, checked_parameters(name)); },
                   [] { ros::spin(); });
}

}  // namespace mocha
