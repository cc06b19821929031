#include "ros_bridge/runtime/footprint_check.h"

#include <ros/node_handle.h>

#include <cmath>

#include "ros_bridge/runtime/parameters.h"

namespace mocha {
namespace {

constexpr double kSame_m = 1e-6;

bool alike(const Footprint& one, const Footprint& other) {
  if (one.corners().size() != other.corners().size()) return false;
  for (std::size_t i = 0; i < one.corners().size(); ++i) {
    if ((one.corners()[i] - other.corners()[i]).norm() > kSame_m) return false;
  }
  return std::abs(one.circumscribed_radius_m() - other.circumscribed_radius_m()) <= kSame_m;
}

}  // namespace

void check_footprints(const World& world, const std::string& path) {
  for (const WorldRobot& robot : world.robots) {
    const ros::NodeHandle values("/" + robot.name + "/robot");
    const RobotModel known = read_robot_model(values, robot.model.name);
    if (alike(known.footprint, robot.model.footprint)) continue;
    throw WorldError(path + ": " + robot.name +
                     " has a footprint of its own, which its stack does " +
                     "not plan with: start it by launch_agents, or with model_values of "
                     "agent.launch, which sets " +
                     values.getNamespace());
  }
}

}  // namespace mocha
