#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <csignal>
#include <exception>
#include <string>

#include "ros_bridge/runtime/parameters.h"

namespace mocha {

inline std::atomic<bool> asked_to_stop{false};

/// As run_node(), for nodes that have a last word to say: on SIGINT and SIGTERM `Node::stop()` is
/// called while its connections are still open. `between(node)` is called between the callbacks,
/// every `period` or more often.
template <typename Node, typename Between>
int run_stopping_node(int argc, char** argv, const std::string& name, ros::WallDuration period,
                      Between between) {
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  const auto ask_to_stop = [](int) { asked_to_stop = true; };
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  ros::NodeHandle node;  // outside: the console closes with the last handle
  try {
    Node instance(node, read_parameters(ros::NodeHandle("~"), name));
    while (ros::ok() && !asked_to_stop) {
      ros::getGlobalCallbackQueue()->callAvailable(period);
      between(instance);
    }
    instance.stop();
  } catch (const std::exception& error) {
    ROS_FATAL("%s: %s", name.c_str(), error.what());
    return 1;
  }
  return 0;
}

}  // namespace mocha
