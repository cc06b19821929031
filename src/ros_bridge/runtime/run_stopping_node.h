#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <memory>
#include <string>

#include "ros_bridge/runtime/clock_watch.h"
#include "ros_bridge/runtime/node_help.h"
#include "ros_bridge/runtime/node_start.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/stop_signals.h"

namespace mocha {

/// As run_node(), for nodes that have a last word to say: on SIGINT and SIGTERM `Node::stop()` is
/// called while its connections are still open. `between(node)` is called between the callbacks,
/// every `period` or more often.
template <typename Node, typename Between>
int run_stopping_node(int argc, char** argv, const std::string& name, ros::WallDuration period,
                      Between between) {
  if (prints_help(argc, argv, name)) return 0;
  const StopSignals stop;
  const NodeStart start(argc, argv, name, ros::init_options::NoSigintHandler);
  ros::NodeHandle node;  // outside: the console closes with the last handle
  ClockWatch clock(node);
  std::unique_ptr<Node> instance;
  const auto work = [&] {
    while (ros::ok() && !stop.came()) {
      ros::getGlobalCallbackQueue()->callAvailable(period);
      between(*instance);
    }
    instance->stop();
  };
  return start.run([&] { instance = std::make_unique<Node>(node, checked_parameters(name)); }, work,
                   [&] { return stop.came(); });
}

}  // namespace mocha
