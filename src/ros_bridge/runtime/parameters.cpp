#include "ros_bridge/runtime/parameters.h"

#include <ros/package.h>

#include "stack/timing.h"
#include "world/robot_values.h"

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

/// What is set in a namespace replaces values.
void assign_set(const ros::NodeHandle& where, ParameterTable& table) {
  XmlRpc::XmlRpcValue values;
  if (!where.getParam("", values) || values.getType() != XmlRpc::XmlRpcValue::TypeStruct) return;
  const std::string source = where.getNamespace();
  YAML::Node map(YAML::NodeType::Map);
  for (auto& item : values) map[item.first] = to_yaml(item.second, source + "/" + item.first);
  table.assign(map, source);
}

ParameterTable robot_values(const ros::NodeHandle& where, const std::string& model) {
  ParameterTable table = load_robot_values(config_path(""), model);
  assign_set(where, table);
  return table;
}

/// Relative to the node's namespace, as the names of its neighbours are.
ros::NodeHandle own_robot() { return ros::NodeHandle("robot"); }

}  // namespace

std::string config_path(const std::string& relative) {
  const std::string package = ros::package::getPath("mocha_ugv");
  if (package.empty()) throw ParameterError("the package mocha_ugv is not on ROS_PACKAGE_PATH");
  return package + "/config/" + relative;
}

ParameterTable read_parameters(const ros::NodeHandle& private_node, const std::string& schema) {
  ParameterTable table = ParameterTable::from_schema(config_path(schema + ".yaml"));
  assign_set(private_node, table);
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
    return robot_values(own_robot(), values.text("robot_model"));
  });
  return values;
}

RobotModel read_robot_model(const ros::NodeHandle& values, const std::string& model) {
  const std::string file = robot_values_file(config_path(""), model);
  const bool own = values.hasParam("");
  return robot_model_of(robot_values(values, model), model,
                        own ? file + " with " + values.getNamespace() : file);
}

RobotModel own_robot_model(const ParameterTable& parameters) {
  return read_robot_model(own_robot(), parameters.text("robot_model"));
}

}  // namespace mocha
