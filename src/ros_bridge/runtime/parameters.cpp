#include "ros_bridge/runtime/parameters.h"

#include <ros/package.h>

#include "stack/timing.h"

namespace mocha {
namespace {

YAML::Node to_yaml(XmlRpc::XmlRpcValue value, const std::string& where) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value));
    case XmlRpc::XmlRpcValue::TypeInt:
      return YAML::Node(static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return YAML::Node(static_cast<double>(value));
    case XmlRpc::XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    default:
      throw ParameterError(where + ": is not a single value");
  }
}

}  // namespace

std::string config_path(const std::string& relative) {
  const std::string package = ros::package::getPath("mocha_ugv");
  if (package.empty()) throw ParameterError("the package mocha_ugv is not on ROS_PACKAGE_PATH");
  return package + "/config/" + relative;
}

ParameterTable read_parameters(const ros::NodeHandle& private_node, const std::string& schema) {
  ParameterTable table = ParameterTable::from_schema(config_path(schema + ".yaml"));
  XmlRpc::XmlRpcValue values;
  if (!private_node.getParam("", values) || values.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return table;
  }
  const std::string source = private_node.getNamespace();
  YAML::Node map;
  for (auto& item : values) map[item.first] = to_yaml(item.second, source + "/" + item.first);
  table.assign(map, source);
  return table;
}

ParameterTable neighbour_parameters(const std::string& node) {
  return read_parameters(ros::NodeHandle(node), node);
}

ParameterTable checked_parameters(const std::string& node) {
  const ParameterTable values = read_parameters(ros::NodeHandle("~"), node);
  check_timing(node, [&](const std::string& name) {
    if (name == node) return values;
    if (name != "robot") return neighbour_parameters(name);
    ParameterTable robot = ParameterTable::from_schema(config_path("robot.yaml"));
    robot.assign_file(config_path("robots/" + values.text("robot_model") + ".yaml"));
    return robot;
  });
  return values;
}

}  // namespace mocha
